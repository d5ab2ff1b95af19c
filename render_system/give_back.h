// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace render_system {

/// Empties a container and gives its memory back: `values = {}` would keep the room for later.
template <class Values>
void give_back(Values& values) {
    Values().swap(values);
}

}  // namespace render_system

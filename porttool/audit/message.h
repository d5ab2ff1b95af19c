// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace porttool {

/// What a commit message says of the edit, as far as its words tell.
struct MessageSays {
    bool fix = false;       ///< something was wrong before
    bool in_text = false;   ///< not the first line says so, but what follows
    bool platform = false;  ///< it names a platform, beyond the tag that it begins with
    bool manner = false;    ///< it is about looks, names, structure or tools
    bool speed = false;
    bool threads = false;  ///< it is about several that run at once
};

/// Reads the first line, then the rest. What the first line says goes before.
MessageSays read_message(std::string_view message);

}  // namespace porttool

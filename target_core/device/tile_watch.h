// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_system/path_watch.h"
#include "target_core/device/tile.h"

namespace target_core {

/// Shows the paths of the tile that is bound, as `kernel` has just left them.
void show_tile(render_system::PathWatch& watch, const Tile& tile, render_system::PathKernel kernel);

}  // namespace target_core

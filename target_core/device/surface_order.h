// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "target_core/device/tile.h"

namespace target_core {

/// Brings surfaces of the same instance together, so that the lanes that shade them mostly read the same rows and skip
/// the same textures. The order never shows in the picture.
void order_surfaces(Tile& tile);

}  // namespace target_core

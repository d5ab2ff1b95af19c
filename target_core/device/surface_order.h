// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "target_core/device/tile.h"

namespace target_core {

/// Brings surfaces of the same instance together, so that the lanes that shade them mostly read the same rows and skip
/// the same textures, and prefetches their triangles. By instance since the material is known only after one more
/// look-up: an instance of many materials gains from the prefetching alone. The order never shows in the picture.
void order_surfaces(Tile& tile);

}  // namespace target_core

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "target_core/device/instance_geometry.h"
#include "target_core/device/tile.h"

namespace target_core {

/// Gives each instance a bin; those whose first triangles have the same material are neighbours.
void assign_bins(std::span<InstanceGeometry> geometry);

/// Brings surfaces of the same instance together, and instances of the same material, so that the lanes that shade
/// them mostly read the same rows and skip the same textures; and prefetches their triangles. By instance since a
/// triangle's own material is known only after one more look-up: an instance of many materials gains less. The order
/// never shows in the picture.
void order_surfaces(Tile& tile);

}  // namespace target_core

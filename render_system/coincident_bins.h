// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "render_system/coincident.h"

namespace render_system::coincident {

/// Bins along a side, for an entry of `count` triangles among so many entries.
double bins_for(size_t count, size_t entries);

/// What lies in the place of a triangle, by `side` times `side` bins of its u and v.
CoincidentSurfaces::Entry entry_of(std::span<const PlacedMesh> scene, const TriangleName& triangle,
                                   const std::vector<TriangleName>& lower, double side);

}  // namespace render_system::coincident

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "render_system/coincident.h"

namespace render_system::coincident {

/// What lies in the place of a triangle, by bins of its u and v: as many as `pairs`, those of all entries, leave room
/// for.
CoincidentSurfaces::Entry entry_of(std::span<const PlacedMesh> scene, const TriangleName& triangle,
                                   const std::vector<TriangleName>& lower, size_t pairs);

}  // namespace render_system::coincident

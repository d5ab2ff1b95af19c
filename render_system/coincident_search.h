// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "render_system/coincident.h"

namespace render_system::coincident {

/// Adds pairs of triangles of different instances that share a surface, one of the two instances `wanted` (empty: all).
/// `boxes`: of the instances.
void find_between_instances(std::span<const PlacedMesh> scene, const std::vector<WorldBox>& boxes,
                            const std::vector<bool>& wanted, std::vector<CoincidentPair>& pairs);

/// Adds the triangles of a mesh that have the corners of a lower one.
void find_copies_within(const PlacedMesh& mesh, uint32_t instance, std::vector<CoincidentPair>& pairs);

}  // namespace render_system::coincident

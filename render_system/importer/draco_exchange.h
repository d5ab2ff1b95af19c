// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace importer {

/// What comes back for a Draco stream: this, `attributes` times DracoAttribute, then 3 uint32_t a triangle, then of
/// each attribute its values, tightly packed.
struct DracoMesh {
    uint32_t points = 0;
    uint32_t triangles = 0;
    uint32_t attributes = 0;
};

struct DracoAttribute {
    uint32_t id = 0;              ///< the unique id, which KHR_draco_mesh_compression names
    uint32_t component_type = 0;  ///< as glTF numbers them
    uint32_t components = 0;
    uint32_t component_size = 0;  ///< bytes
};

}  // namespace importer

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render_system/host_scene.h"
#include "render_system/loader/gltf_document.h"

namespace render_system {

/// Marks the materials that the triangles of the meshes in `meshes` use: one flag a material of the file, and one more
/// for glTF's default material.
std::vector<bool> used_materials(const GltfDocument& document, const std::vector<int>& meshes);

/// A mesh, and what can deform it.
struct LoadedMesh {
    HostMesh mesh;
    std::shared_ptr<const RestMesh> rest;  ///< null: nothing can
    uint32_t joints = 0;                   ///< how many its vertices name, from 0 on; 0: it has no skin
};

/// One mesh of the file, all its triangle primitives in one, each triangle with its material. Flat normals and tangents
/// are made where they are missing and needed; `scene` has the materials already. Morph targets come along, and where
/// it is `skinned` joints and weights. Throws LoadError. Points, lines and what else is left out goes into the
/// document's omissions.
LoadedMesh read_mesh(GltfDocument& document, int mesh, bool skinned, const HostScene& scene);

}  // namespace render_system

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render_system/host_scene.h"
#include "render_system/loader/gltf_document.h"

namespace render_system {

/// Marks the materials that the triangles of the meshes in `meshes` use: one flag a material of the file, and one more
/// for glTF's default material.
std::vector<bool> used_materials(const GltfDocument& document, const std::vector<int>& meshes);

/// One mesh of the file, all its triangle primitives in one, each triangle with its material. Flat normals and tangents
/// are made where they are missing and needed; `scene` has the materials already. Throws LoadError. Points, lines and
/// what else is left out goes into the document's omissions.
HostMesh read_mesh(GltfDocument& document, int mesh, const HostScene& scene);

}  // namespace render_system

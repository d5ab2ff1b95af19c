// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render_system/host_scene.h"
#include "render_system/loader/gltf_document.h"

namespace render_system {

/// Adds all materials of the file to the scene, under their own numbers, and the textures that they use; last the
/// default material of glTF if `used` asks for it. Materials that `used` leaves out stay plain, so that their textures
/// need not be read. Fills in what goes wrong with images as warnings, and what is not supported as omissions.
/// `used` has one flag a material, and one more for the default material.
void add_materials(GltfDocument& document, const std::vector<bool>& used, HostScene& scene);

}  // namespace render_system

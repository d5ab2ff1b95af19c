// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "render_system/loader/gltf_document.h"

namespace render_system {

/// The file's skins. Throws LoadError where one has no joints.
std::vector<GltfSkin> read_skins(const nlohmann::json& document);

/// The matrices that take a mesh into the space of each of a skin's joints. Throws LoadError where there are fewer than
/// joints.
std::vector<glm::dmat4> read_inverse_binds(const GltfDocument& document, int skin);

}  // namespace render_system

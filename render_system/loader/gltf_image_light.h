// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "render_system/host_scene.h"
#include "render_system/loader/gltf_document.h"

namespace render_system {

/// The part of EXT_lights_image_based that the scene to show names, null where there is none. The document has passed
/// check_gltf_schema.
const nlohmann::json* image_light(const nlohmann::json& root);

/// What it lights the scene with: the sharpest cube map of the light as an equirectangular sky, turned and scaled as it
/// says. The map is not filtered further: what its blurred levels and coefficients approximate is rendered. Throws
/// LoadError, with the light's place, where an image cannot be read or the faces are no squares of one size.
Sky read_image_light(const nlohmann::json& light, const GltfDocument& document);

}  // namespace render_system

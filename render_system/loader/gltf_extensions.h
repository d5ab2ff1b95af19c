// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "render_system/loader/gltf_document.h"

namespace render_system {

/// Refuses what the file cannot be shown without, and notes among the omissions what it uses and does not get.
/// Extensions that change nothing one sees pass in silence. The document has passed check_gltf_schema.
void check_extensions(const nlohmann::json& document, Omissions& omissions);

/// Gives each primitive the material that KHR_materials_variants maps it to under that name; without a name nothing is
/// changed. Throws LoadError, with the names that there are, where the file has no such variant.
void apply_variant(nlohmann::json& document, const std::string& variant);

/// Makes the images of EXT_texture_webp the textures' own.
void take_webp_images(nlohmann::json& document);

}  // namespace render_system

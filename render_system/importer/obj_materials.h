// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "render_system/importer/glb_builder.h"

namespace tinyobj {
struct material_t;
}

namespace importer {

/// A material of an MTL file as glTF has it; its pictures go to the builder. docs/formats.md says what becomes of each
/// statement.
nlohmann::json gltf_material(const tinyobj::material_t& source, const std::filesystem::path& folder,
                             GlbBuilder& builder);

}  // namespace importer

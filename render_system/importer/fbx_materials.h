// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "render_system/importer/glb_builder.h"

struct aiMaterial;
struct aiScene;

namespace importer {

/// A material of an FBX file, as Assimp tells it, as glTF has it; its pictures go to the builder.
nlohmann::json gltf_material(const aiMaterial& source, const aiScene& scene, const std::filesystem::path& folder,
                             GlbBuilder& builder);

}  // namespace importer

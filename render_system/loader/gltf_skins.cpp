// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_skins.h"

#include <nlohmann/json.hpp>

#include "render_system/loader/gltf_accessors.h"
#include "render_system/loader/load_error.h"

namespace render_system {

using nlohmann::json;

std::vector<GltfSkin> read_skins(const json& document) {
    std::vector<GltfSkin> skins;
    if (!document.contains("skins")) return skins;
    for (const json& entry : document["skins"]) {
        GltfSkin skin;
        skin.joints = entry["joints"].get<std::vector<int>>();
        skin.inverse_binds = entry.value("inverseBindMatrices", -1);
        if (skin.joints.empty())
            fail_at("/skins/" + std::to_string(skins.size()) + "/joints",
                    "names no joint, so the skin has no skeleton" + EXPORT_AGAIN);
        skins.push_back(std::move(skin));
    }
    return skins;
}

std::vector<glm::dmat4> read_inverse_binds(const GltfDocument& document, int index) {
    const GltfSkin& skin = document.skins[static_cast<size_t>(index)];
    std::vector<glm::dmat4> matrices(skin.joints.size(), glm::dmat4(1.0));
    if (skin.inverse_binds < 0) return matrices;
    const std::string place = "/skins/" + std::to_string(index) + "/inverseBindMatrices";
    if (document.model.accessors[static_cast<size_t>(skin.inverse_binds)].componentType !=
        TINYGLTF_COMPONENT_TYPE_FLOAT)
        fail_at(place, "must hold floats" + EXPORT_AGAIN);
    const std::vector<float> numbers = read_floats(document, skin.inverse_binds, 16);
    if (numbers.size() / 16 < matrices.size())
        fail_at(place, "has " + std::to_string(numbers.size() / 16) + " matrices for " +
                           std::to_string(matrices.size()) + " joints" + EXPORT_AGAIN);
    for (size_t i = 0; i < matrices.size() * 16; ++i)
        matrices[i / 16][static_cast<int>(i / 4 % 4)][static_cast<int>(i % 4)] = static_cast<double>(numbers[i]);
    return matrices;
}

}  // namespace render_system

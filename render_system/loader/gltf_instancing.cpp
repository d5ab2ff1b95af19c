// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_instancing.h"

#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "render_system/loader/gltf_accessors.h"
#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

constexpr uint64_t kMostCopies = uint64_t{1} << 20;
constexpr const char* kWhere = "/extensions/EXT_mesh_gpu_instancing/attributes";

// One of the attributes; empty where the node has none of that name.
template <class Vec>
std::vector<Vec> instance_attribute(const GltfDocument& document, const tinygltf::Value& attributes, const char* name) {
    std::vector<Vec> values;
    if (attributes.Has(name)) append_vectors(document, attributes.Get(name).GetNumberAsInt(), true, values);
    return values;
}

}  // namespace

const tinygltf::Value* instancing_of(const tinygltf::Node& node) {
    const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
    return found == node.extensions.end() ? nullptr : &found->second;
}

uint64_t instance_count(const GltfDocument& document, const tinygltf::Value& instancing, const std::string& place) {
    const tinygltf::Value& attributes = instancing.Get("attributes");
    std::optional<uint64_t> count;
    for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
        if (!attributes.Has(name)) continue;
        const uint64_t own = accessor_count(document, attributes.Get(name).GetNumberAsInt());
        if (own == count.value_or(own))
            count = own;
        else
            fail_at(place + kWhere, "differ in their numbers of elements" + EXPORT_AGAIN);
    }
    if (count) return *count;
    // Others, such as _ID, say nothing of places, but how many there are.
    const std::vector<std::string> names = attributes.Keys();
    return names.empty() ? 0 : accessor_count(document, attributes.Get(names.front()).GetNumberAsInt());
}

void check_instance_total(uint64_t total) {
    if (total <= kMostCopies) return;
    fail_at("", "EXT_mesh_gpu_instancing makes " + std::to_string(total) + " instances; " +
                    std::to_string(kMostCopies) + " are the most, split the scene");
}

std::vector<glm::dmat4> instance_transforms(const GltfDocument& document, const tinygltf::Value& instancing,
                                            const std::string& place) {
    const tinygltf::Value& attributes = instancing.Get("attributes");
    const uint64_t count = instance_count(document, instancing, place);
    const auto moves = instance_attribute<glm::vec3>(document, attributes, "TRANSLATION");
    const auto turns = instance_attribute<glm::vec4>(document, attributes, "ROTATION");
    const auto scales = instance_attribute<glm::vec3>(document, attributes, "SCALE");
    std::vector<glm::dmat4> transforms(count, glm::dmat4(1.0));
    for (size_t i = 0; i < count; ++i) {
        glm::dmat4& matrix = transforms[i];
        if (!turns.empty()) {
            const glm::dvec4 turn(turns[i]);
            if (!(glm::length(turn) > 0.0)) fail_at(place + kWhere + "/ROTATION", "has no length" + EXPORT_AGAIN);
            matrix = glm::mat4_cast(glm::normalize(glm::dquat(turn.w, turn.x, turn.y, turn.z)));
        }
        for (int c = 0; c < 3 && !scales.empty(); ++c) matrix[c] *= static_cast<double>(scales[i][c]);
        if (!moves.empty()) matrix[3] = glm::dvec4(glm::dvec3(moves[i]), 1.0);
    }
    return transforms;
}

}  // namespace render_system

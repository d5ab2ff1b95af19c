// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_image_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "render_system/loader/gltf_textures.h"
#include "render_system/loader/load_error.h"
#include "render_system/scene_limits.h"
#include "render_system/texel.h"

namespace render_system {

namespace {

using nlohmann::json;
constexpr uint32_t kLargestSkyHeight = 1024;

// Six squares of linear radiance, in the order +x -x +y -y +z -z.
struct CubeMap {
    uint32_t size = 0;
    std::array<std::vector<glm::vec3>, 6> faces;
};

// With an alpha below 1 the picture is RGBD: colours, on the sRGB curve, divided by alpha once they are linear.
std::vector<glm::vec3> linear_face(const Image& image) {
    std::vector<glm::vec3> texels(image.texels());
    for (size_t i = 0; i < texels.size(); ++i) {
        const glm::vec4 stored = image.texel(i);
        for (int c = 0; c < 3; ++c) texels[i][c] = srgb_to_linear(std::clamp(stored[c], 0.0f, 1.0f));
        if (stored.w < 1.0f) texels[i] /= std::max(stored.w, 1.0f / 255.0f);
    }
    return texels;
}

CubeMap read_cube_map(const json& images, const GltfDocument& document, const std::string& place) {
    CubeMap map;
    for (size_t i = 0; i < map.faces.size(); ++i) {
        const Image image = read_document_image(document, images[i].get<int>());
        if (i == 0) map.size = image.width;
        if (image.width != map.size || image.height != map.size || image.is_hdr) {
            fail_at(place + "/" + std::to_string(i), "is no square of 8 or 16 bits like the first face" + EXPORT_AGAIN);
        }
        map.faces[i] = linear_face(image);
    }
    return map;
}

// The faces are as one sees them from the middle: those of OpenGL's cube maps, mirrored.
glm::vec3 radiance_in(const CubeMap& map, const glm::dvec3& way) {
    const glm::dvec3 size = glm::abs(way);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const bool positive = way[axis] >= 0.0;
    const double sign = positive ? 1.0 : -1.0;
    const double across = axis == 0 ? sign * way.z : axis == 1 ? -way.x : -sign * way.x;
    const double down = axis == 1 ? sign * way.z : -way.y;
    const auto texel = [&](double place) {
        const double t = 0.5 * (place / size[axis] + 1.0) * static_cast<double>(map.size);
        return std::min(static_cast<uint32_t>(std::max(t, 0.0)), map.size - 1);
    };
    return map
        .faces[static_cast<size_t>(2 * axis + (positive ? 0 : 1))][size_t{texel(down)} * map.size + texel(across)];
}

}  // namespace

const json* image_light(const json& root) {
    const char* const name = "EXT_lights_image_based";
    const size_t shown = root.value("scene", size_t{0});
    if (!root.contains("scenes") || shown >= root["scenes"].size()) return nullptr;
    const json& scene = root["scenes"][shown];
    if (!scene.contains("extensions") || !scene["extensions"].contains(name)) return nullptr;
    return &root["extensions"][name]["lights"][scene["extensions"][name]["light"].get<size_t>()];
}

Sky read_image_light(const json& light, const GltfDocument& document) {
    const std::string place = "/extensions/EXT_lights_image_based/lights";
    const json& levels = light["specularImages"];
    if (levels.empty() || levels[0].size() != 6) fail_at(place, "its first level has no six images" + EXPORT_AGAIN);
    const CubeMap map = read_cube_map(levels[0], document, place + "/specularImages/0");
    const double intensity = light.value("intensity", 1.0);
    const json turn = light.value("rotation", json{0.0, 0.0, 0.0, 1.0});
    const glm::dquat rotation(turn[3].get<double>(), turn[0].get<double>(), turn[1].get<double>(),
                              turn[2].get<double>());
    if (!(glm::length(rotation) > 0.0)) fail_at(place, "its rotation has no length" + EXPORT_AGAIN);
    if (!(intensity >= 0.0 && intensity <= static_cast<double>(BRIGHTEST_LIGHT) / 256.0)) {
        fail_at(place, "its intensity is no number from 0 to 1e9" + EXPORT_AGAIN);
    }
    const glm::dmat3 back = glm::transpose(glm::mat3_cast(glm::normalize(rotation)));
    constexpr double kPi = 3.14159265358979323846;
    Sky sky;
    sky.height = std::min(2 * map.size, kLargestSkyHeight);
    sky.width = 2 * sky.height;
    sky.texels.reserve(size_t{sky.width} * sky.height);
    for (uint32_t y = 0; y < sky.height; ++y) {
        const double polar = kPi * (y + 0.5) / sky.height;
        for (uint32_t x = 0; x < sky.width; ++x) {
            const double around = 2.0 * kPi * ((x + 0.5) / sky.width - 0.5);
            const glm::dvec3 way(std::sin(around) * std::sin(polar), std::cos(polar),
                                 -std::cos(around) * std::sin(polar));
            sky.texels.emplace_back(static_cast<float>(intensity) * radiance_in(map, back * way), 1.0f);
        }
    }
    return sky;
}

}  // namespace render_system

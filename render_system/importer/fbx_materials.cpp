// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/importer/fbx_materials.h"

#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <optional>

#include "render_system/importer/texture_name.h"

namespace importer {

namespace {

using nlohmann::json;

float share(float value) { return value >= 0.0f ? std::min(value, 1.0f) : 0.0f; }  // NaN: 0

class FbxMaterial {
public:
    FbxMaterial(const aiMaterial& source, const aiScene& scene, const std::filesystem::path& folder,
                GlbBuilder& builder)
        : source_(source), scene_(scene), folder_(folder), builder_(builder) {}

    json convert() {
        aiString name;
        source_.Get(AI_MATKEY_NAME, name);
        material_ = {{"name", name.C_Str()}, {"doubleSided", true}};
        json& pbr = material_["pbrMetallicRoughness"];
        const json color = base_color();
        const float opacity = share(number(AI_MATKEY_OPACITY).value_or(1.0f));
        pbr["baseColorFactor"] = {color[0], color[1], color[2], opacity};
        if (opacity < 1.0f || has(aiTextureType_OPACITY)) material_["alphaMode"] = "BLEND";
        add_base_texture(pbr);
        add_surface(pbr);
        add_emission();
        for (aiTextureType type : {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA}) {
            if (has(type) && !material_.contains("normalTexture")) material_["normalTexture"] = info(type);
        }
        if (has(aiTextureType_HEIGHT) && !material_.contains("normalTexture")) builder_.leave_out("bump maps");
        if (has(aiTextureType_SPECULAR) || has(aiTextureType_SHININESS)) builder_.leave_out("specular maps");
        return material_;
    }

private:
    bool has(aiTextureType type) const { return source_.GetTextureCount(type) > 0; }

    std::optional<float> number(const char* key, unsigned type, unsigned index) const {
        float value = 0.0f;
        if (source_.Get(key, type, index, value) != aiReturn_SUCCESS || !std::isfinite(value)) return {};
        return value;
    }

    std::optional<json> color(const char* key, unsigned type, unsigned index) const {
        aiColor3D value;
        if (source_.Get(key, type, index, value) != aiReturn_SUCCESS) return {};
        return json{share(value.r), share(value.g), share(value.b)};
    }

    aiTextureType base_type() const {
        return has(aiTextureType_BASE_COLOR) ? aiTextureType_BASE_COLOR : aiTextureType_DIFFUSE;
    }

    json base_color() const {
        if (has(base_type())) {
            // What exporters leave beside a picture is often a default that was never meant to tint it.
            return {1.0f, 1.0f, 1.0f};
        }
        if (const auto base = color(AI_MATKEY_BASE_COLOR)) return *base;
        return color(AI_MATKEY_COLOR_DIFFUSE).value_or(json{0.8f, 0.8f, 0.8f});
    }

    void add_base_texture(json& pbr) {
        const bool colored = has(base_type()), covered = has(aiTextureType_OPACITY);
        if (!colored && !covered) return;
        if (!covered) {
            pbr["baseColorTexture"] = info(base_type());
            return;
        }
        const int base = colored ? image(base_type()) : -1, alpha = image(aiTextureType_OPACITY);
        json pack = nullptr;
        if (alpha >= 0 && alpha != base) pack = {{"alpha", alpha}};
        if (base >= 0 || alpha >= 0)
            pbr["baseColorTexture"] = info(colored ? base_type() : aiTextureType_OPACITY, base, pack);
    }

    void add_surface(json& pbr) {
        const auto metallic = number(AI_MATKEY_METALLIC_FACTOR), roughness = number(AI_MATKEY_ROUGHNESS_FACTOR);
        const bool metal_map = has(aiTextureType_METALNESS), rough_map = has(aiTextureType_DIFFUSE_ROUGHNESS);
        pbr["metallicFactor"] = metal_map ? 1.0f : share(metallic.value_or(0.0f));
        if (metallic || roughness || metal_map || rough_map) {
            pbr["roughnessFactor"] = rough_map ? 1.0f : share(roughness.value_or(0.5f));
        } else {
            // Phong: Beckmann's distribution for its exponent, as for MTL.
            const json specular = color(AI_MATKEY_COLOR_SPECULAR).value_or(json{0.0f, 0.0f, 0.0f});
            const bool shines = specular[0] > 0.0f || specular[1] > 0.0f || specular[2] > 0.0f;
            const float exponent = std::max(0.0f, number(AI_MATKEY_SHININESS).value_or(0.0f));
            pbr["roughnessFactor"] = shines ? std::pow(2.0f / (exponent + 2.0f), 0.25f) : 1.0f;
        }
        if (!metal_map && !rough_map) return;
        json pack = json::object();
        const int rough = rough_map ? image(aiTextureType_DIFFUSE_ROUGHNESS) : -1;
        const int metal = metal_map ? image(aiTextureType_METALNESS) : -1;
        if (rough >= 0) pack["green"] = rough;
        if (metal >= 0) pack["blue"] = metal;
        if (!pack.empty()) {
            const aiTextureType type = rough_map ? aiTextureType_DIFFUSE_ROUGHNESS : aiTextureType_METALNESS;
            pbr["metallicRoughnessTexture"] = info(type, -1, pack);
        }
    }

    void add_emission() {
        json emission = color(AI_MATKEY_COLOR_EMISSIVE).value_or(json{0.0f, 0.0f, 0.0f});
        for (aiTextureType type : {aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE}) {
            if (!has(type) || image(type) < 0) continue;
            material_["emissiveTexture"] = info(type);
            if (emission == json{0.0f, 0.0f, 0.0f}) emission = {1.0f, 1.0f, 1.0f};
            break;
        }
        material_["emissiveFactor"] = emission;
    }

    // The number of the picture; -1 where it is of no kind that can be read.
    int image(aiTextureType type) {
        aiString name;
        if (source_.GetTexture(type, 0, &name) != aiReturn_SUCCESS || name.length == 0) return -1;
        const aiTexture* embedded = scene_.GetEmbeddedTexture(name.C_Str());
        if (!embedded) return static_cast<int>(builder_.add_image(texture_uri(name.C_Str(), folder_)));
        if (embedded->mHeight != 0 || embedded->mWidth == 0) {
            builder_.leave_out("embedded pictures that are not compressed");
            return -1;
        }
        // Some kinds are told by a name's ending alone.
        const std::string hint(embedded->achFormatHint, strnlen(embedded->achFormatHint, HINTMAXTEXTURELEN));
        return static_cast<int>(builder_.add_image(embedded->pcData, embedded->mWidth, std::string("image/.") + hint));
    }

    json info(aiTextureType type) {
        const int source = image(type);
        return source < 0 ? json(nullptr) : info(type, source, nullptr);
    }

    json info(aiTextureType type, int source, const json& pack) {
        int uv_set = 0, wrap = aiTextureMapMode_Wrap;
        source_.Get(AI_MATKEY_UVWSRC(type, 0), uv_set);
        source_.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), wrap);
        json info = {{"index", builder_.add_texture(source, wrap == aiTextureMapMode_Clamp, pack)}};
        if (uv_set > 0 && uv_set < AI_MAX_NUMBER_OF_TEXTURECOORDS) info["texCoord"] = uv_set;
        aiUVTransform transform;
        if (source_.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) != aiReturn_SUCCESS) return info;
        const aiVector2D &scale = transform.mScaling, &move = transform.mTranslation;
        const bool moved = scale.x != 1.0f || scale.y != 1.0f || move.x != 0.0f || move.y != 0.0f;
        if (moved && std::isfinite(scale.x + scale.y + move.x + move.y)) {
            info["extensions"]["KHR_texture_transform"] = {{"scale", {scale.x, scale.y}},
                                                           {"offset", {move.x, 1.0f - scale.y - move.y}}};
        }
        return info;
    }

    const aiMaterial& source_;
    const aiScene& scene_;
    const std::filesystem::path& folder_;
    GlbBuilder& builder_;
    json material_;
};

// What is null was of no kind that can be read.
void drop_nulls(json& object) {
    for (auto member = object.begin(); member != object.end();) {
        if (member->is_object()) drop_nulls(*member);
        member = member->is_null() ? object.erase(member) : std::next(member);
    }
}

}  // namespace

json gltf_material(const aiMaterial& source, const aiScene& scene, const std::filesystem::path& folder,
                   GlbBuilder& builder) {
    json material = FbxMaterial(source, scene, folder, builder).convert();
    drop_nulls(material);
    return material;
}

}  // namespace importer

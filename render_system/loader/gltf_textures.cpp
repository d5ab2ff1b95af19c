// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_textures.h"

#include <cmath>

#include "render_system/loader/image_reader.h"
#include "render_system/loader/load_error.h"
#include "render_system/loader/uri.h"

namespace render_system {

namespace {

TextureWrap wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::clamp_to_edge;
    if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return TextureWrap::mirrored_repeat;
    return TextureWrap::repeat;
}

bool uses_mips(int min_filter) {
    return min_filter != TINYGLTF_TEXTURE_FILTER_NEAREST && min_filter != TINYGLTF_TEXTURE_FILTER_LINEAR;
}

bool nearest_inside(int min_filter) {
    return min_filter == TINYGLTF_TEXTURE_FILTER_NEAREST ||
           min_filter == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
           min_filter == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
}

void make_roughness(Image& image, float glossiness) {
    for (uint32_t& texel : image.bytes) {
        const float alpha = static_cast<float>(texel >> 24) / 255.0f;
        texel = 0xFF000000u | static_cast<uint32_t>(std::lround(255.0f * (1.0f - alpha * glossiness))) << 8;
    }
    for (glm::vec4& texel : image.floats) texel = {0.0f, 1.0f - texel.w * glossiness, 0.0f, 1.0f};
}

std::string image_place(int image) { return "/images/" + std::to_string(image); }

}  // namespace

GltfTextures::Key GltfTextures::key_of(int texture, TextureRole role) const {
    const tinygltf::Texture& source = document_.model.textures[static_cast<size_t>(texture)];
    Key key;
    key.image = source.source;
    key.role = role;
    if (source.sampler < 0) return key;
    const tinygltf::Sampler& sampler = document_.model.samplers[static_cast<size_t>(source.sampler)];
    key.wrap_s = wrap_of(sampler.wrapS);
    key.wrap_t = wrap_of(sampler.wrapT);
    key.mips = uses_mips(sampler.minFilter);
    // One filter serves both ways; where only one is given, that one.
    key.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ||
                  (sampler.magFilter < 0 && nearest_inside(sampler.minFilter));
    return key;
}

uint32_t GltfTextures::add(int texture, TextureRole role, std::optional<float> glossiness) {
    Key key = key_of(texture, role);
    key.glossiness = glossiness;
    if (key.image < 0) return load(texture, key);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    return known_[key] = load(texture, key);
}

uint32_t GltfTextures::load(int texture, const Key& key) {
    HostTexture result;
    try {
        if (key.image < 0) fail_at("", "has no image in a supported format; export it as PNG, JPEG or WebP");
        Image image = read(key.image);
        if (key.glossiness) make_roughness(image, *key.glossiness);
        result = build_texture(std::move(image), key.role, key.mips);
    } catch (LoadError& error) {
        if (error.hostile) {
            error.message = image_place(key.image) + ": " + error.message;
            throw;
        }
        const bool is_data = key.role == TextureRole::data;
        warn(texture, key.image,
             error.message + (is_data ? "; it is left out" : "; a placeholder is shown in its stead"));
        if (is_data) return NONE;
        result = build_texture(placeholder_image(), key.role, false);
        result.nearest = true;
        return scene_.add_texture(std::move(result));
    }
    const std::string& name = document_.model.textures[static_cast<size_t>(texture)].name;
    result.name = name.empty() ? image_place(key.image) : name;
    result.wrap_s = key.wrap_s;
    result.wrap_t = key.wrap_t;
    result.nearest = key.nearest;
    return scene_.add_texture(std::move(result));
}

Image GltfTextures::read(int image) const {
    const GltfImage& source = document_.images[static_cast<size_t>(image)];
    if (source.buffer_view >= 0) return read_image(document_.view_bytes(source.buffer_view), source.mime_type);
    if (is_data_uri(source.uri)) return read_image(decode_data_uri(source.uri, ""), "");
    const std::filesystem::path file = file_of_uri(source.uri, document_.path.parent_path(), document_.reach, "");
    try {
        const FileBytes bytes(file);
        return read_image(bytes.bytes(), file.string());
    } catch (LoadError& error) {
        error.message = file.string() + ": " + error.message;
        throw;
    }
}

void GltfTextures::warn(int texture, int image, const std::string& why) {
    const std::string place = image >= 0 ? image_place(image) : "/textures/" + std::to_string(texture);
    if (!warned_.insert(place).second) return;
    document_.warnings.push_back(place + ": " + why);
}

}  // namespace render_system

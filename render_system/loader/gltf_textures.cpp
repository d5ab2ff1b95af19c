// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_textures.h"

#include <cmath>

#include "render_system/loader/image_reader.h"
#include "render_system/loader/load_error.h"
#include "render_system/loader/uri.h"
#include "render_system/texel.h"

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
    for (glm::u16vec4& texel : image.shorts) {
        const float rough = 65535.0f - static_cast<float>(texel.w) * glossiness;
        texel = glm::u16vec4(0, std::lround(rough), 0, 65535);
    }
    for (glm::vec4& texel : image.floats) texel = {0.0f, 1.0f - texel.w * glossiness, 0.0f, 1.0f};
}

// What the importer's own extension may fill of a texture (render_system/importer/glb_builder.h).
constexpr std::array<const char*, 4> kChannels{"red", "green", "blue", "alpha"};

constexpr uint32_t kWhite = 0xFFFFFFFFu;

// An image as bytes, so that other images' bytes can be put into it.
void make_bytes(Image& image) {
    if (!image.bytes.empty()) return;
    std::vector<uint32_t> bytes;
    for (size_t i = 0; i < image.texels(); ++i) bytes.push_back(pack_texel(image.texel(i), TexelFormat::rgba8));
    image.bytes = std::move(bytes);
    image.shorts = {};
    image.floats = {};
    image.is_hdr = false;
}

std::string image_place(int image) { return "/images/" + std::to_string(image); }

}  // namespace

Image read_document_image(const GltfDocument& document, int image) {
    const GltfImage& source = document.images[static_cast<size_t>(image)];
    if (source.buffer_view >= 0) return read_image(document.view_bytes(source.buffer_view), source.mime_type);
    if (is_data_uri(source.uri)) return read_image(decode_data_uri(source.uri, ""), "");
    const std::filesystem::path file = file_of_uri(source.uri, document.path.parent_path(), document.reach, "");
    try {
        const FileBytes bytes(file);
        return read_image(bytes.bytes(), file.string());
    } catch (LoadError& error) {
        error.message = file.string() + ": " + error.message;
        throw;
    }
}

GltfTextures::Key GltfTextures::key_of(int texture, TextureRole role) const {
    const tinygltf::Texture& source = document_.model.textures[static_cast<size_t>(texture)];
    Key key;
    key.image = source.source;
    key.role = role;
    const auto pack = source.extensions.find("PORTTOOL_pack");
    if (pack != source.extensions.end()) {
        for (size_t i = 0; i < kChannels.size(); ++i) {
            if (pack->second.Has(kChannels[i])) key.packed[i] = pack->second.Get(kChannels[i]).GetNumberAsInt();
        }
    }
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
    if (key.image < 0 && !key.is_packed()) return load(texture, key);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    return known_[key] = load(texture, key);
}

uint32_t GltfTextures::load(int texture, const Key& key) {
    HostTexture result;
    try {
        if (key.image < 0 && !key.is_packed())
            fail_at("", "has no image in a supported format; export it as PNG, JPEG or WebP");
        Image image = key.is_packed() ? read_packed(key) : read_document_image(document_, key.image);
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

Image GltfTextures::read_packed(const Key& key) {
    Image image;
    if (key.image >= 0) image = read_document_image(document_, key.image);
    make_bytes(image);
    for (size_t channel = 0; channel < key.packed.size(); ++channel) {
        if (key.packed[channel] >= 0) pack(image, channel, key.packed[channel]);
    }
    if (image.bytes.empty()) fail_at("", "none of its images can be read");
    return image;
}

// One channel of `image`, which gets the source's size where it has none. A source that cannot be read leaves it.
void GltfTextures::pack(Image& image, size_t channel, int source) {
    Image other;
    try {
        other = read_document_image(document_, source);
    } catch (const LoadError& error) {
        if (error.hostile) throw;
        return warn(-1, source, error.message + "; it is left out");
    }
    make_bytes(other);
    if (image.bytes.empty()) {
        image.width = other.width;
        image.height = other.height;
        image.bytes.assign(other.bytes.size(), kWhite);
    }
    const unsigned shift = static_cast<unsigned>(8 * channel);
    for (uint32_t y = 0; y < image.height; ++y) {
        const size_t row = size_t{y} * other.height / image.height * other.width;
        for (uint32_t x = 0; x < image.width; ++x) {
            const uint32_t value = other.bytes[row + size_t{x} * other.width / image.width] & 255u;
            uint32_t& texel = image.bytes[size_t{y} * image.width + x];
            texel = (texel & ~(255u << shift)) | value << shift;
        }
    }
}

void GltfTextures::warn(int texture, int image, const std::string& why) {
    const std::string place = image >= 0 ? image_place(image) : "/textures/" + std::to_string(texture);
    if (!warned_.insert(place).second) return;
    document_.unread_images.push_back({place, why});
}

}  // namespace render_system

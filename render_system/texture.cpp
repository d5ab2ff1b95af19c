// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/texture.h"

#include <algorithm>

#include "render_system/texel.h"

namespace render_system {

namespace {

struct Level {
    uint32_t width;
    uint32_t height;
    std::vector<glm::vec4> texels;
};

// The common case, where both sides are even: the mean of four.
Level halve_evenly(const Level& level) {
    Level half{level.width / 2, level.height / 2, {}};
    half.texels.reserve(static_cast<size_t>(half.width) * half.height);
    for (size_t y = 0; y < half.height; ++y) {
        const glm::vec4* upper = &level.texels[2 * y * level.width];
        const glm::vec4* lower = upper + level.width;
        for (size_t x = 0; x < half.width; ++x, upper += 2, lower += 2) {
            half.texels.push_back(0.25f * ((upper[0] + upper[1]) + (lower[0] + lower[1])));
        }
    }
    return half;
}

// Averages `from` values (step `stride` apart) into `to`: output i covers [i * from / to, (i + 1) * from / to).
// With from = 2 * to this is the plain mean of two.
void average_line(const glm::vec4* in, uint32_t from, size_t in_stride, glm::vec4* out, uint32_t to,
                  size_t out_stride) {
    for (uint32_t i = 0; i < to; ++i) {
        // In units of 1 / to of an input texel, so that all borders are whole numbers.
        const uint64_t begin = static_cast<uint64_t>(i) * from;
        const uint64_t end = begin + from;
        glm::dvec4 sum(0.0);
        for (uint64_t j = begin / to; j * to < end; ++j) {
            const uint64_t covered = std::min(end, (j + 1) * to) - std::max(begin, j * to);
            sum += static_cast<double>(covered) * glm::dvec4(in[j * in_stride]);
        }
        out[i * out_stride] = sum / static_cast<double>(from);
    }
}

Level halve(const Level& level) {
    if (level.width % 2 == 0 && level.height % 2 == 0) return halve_evenly(level);
    const uint32_t width = std::max(1u, level.width / 2);
    const uint32_t height = std::max(1u, level.height / 2);
    std::vector<glm::vec4> rows(static_cast<size_t>(width) * level.height);
    for (size_t y = 0; y < level.height; ++y) {
        average_line(&level.texels[y * level.width], level.width, 1, &rows[y * width], width, 1);
    }
    Level half{width, height, std::vector<glm::vec4>(static_cast<size_t>(width) * height)};
    for (size_t x = 0; x < width; ++x) average_line(&rows[x], level.height, width, &half.texels[x], height, width);
    return half;
}

Level linear_level(const Image& image, TexelFormat format) {
    Level level{image.width, image.height, {}};
    if (image.floats.empty()) {
        level.texels.reserve(image.bytes.size());
        for (uint32_t texel : image.bytes) level.texels.push_back(unpack_texel(texel, format));
        return level;
    }
    level.texels = image.floats;
    for (glm::vec4& texel : level.texels) {
        if (format == TexelFormat::rgba8_srgb) {
            for (int i = 0; i < 3; ++i) texel[i] = srgb_to_linear(texel[i]);
        } else if (format == TexelFormat::rgb9e5) {
            texel = glm::vec4(unpack_rgb9e5(pack_rgb9e5(glm::vec3(texel))), 1.0f);  // clamped; NaN gone
        }
    }
    return level;
}

uint32_t full_chain_levels(uint32_t width, uint32_t height) {
    uint32_t levels = 1;
    while (std::max(width, height) >> levels) ++levels;
    return levels;
}

}  // namespace

HostTexture build_texture(const Image& image, TextureRole role, bool with_mips) {
    HostTexture texture;
    texture.width = image.width;
    texture.height = image.height;
    texture.levels = with_mips ? full_chain_levels(image.width, image.height) : 1;
    texture.format = image.is_hdr                 ? TexelFormat::rgb9e5
                     : role == TextureRole::color ? TexelFormat::rgba8_srgb
                                                  : TexelFormat::rgba8;
    texture.texels = image.bytes;
    if (texture.levels == 1 && !image.bytes.empty()) return texture;
    Level level = linear_level(image, texture.format);
    if (image.bytes.empty()) {
        for (const glm::vec4& texel : level.texels) texture.texels.push_back(pack_texel(texel, texture.format));
    }
    for (uint32_t i = 1; i < texture.levels; ++i) {
        level = halve(level);
        for (const glm::vec4& texel : level.texels) texture.texels.push_back(pack_texel(texel, texture.format));
    }
    return texture;
}

glm::vec3 mean_color(const HostTexture& texture) {
    const size_t count = static_cast<size_t>(texture.width) * texture.height;
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < count; ++i) sum += glm::dvec3(unpack_texel(texture.texels[i], texture.format));
    return sum / static_cast<double>(count);
}

Image placeholder_image() {
    constexpr uint32_t MAGENTA = 0xFFFF00FFu;
    constexpr uint32_t BLACK = 0xFF000000u;
    Image image;
    image.width = 8;
    image.height = 8;
    for (uint32_t i = 0; i < 64; ++i) image.bytes.push_back(((i / 8) + i) % 2 == 0 ? MAGENTA : BLACK);
    return image;
}

}  // namespace render_system

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/texture.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "render_system/give_back.h"
#include "render_system/texel.h"

namespace render_system {

namespace {

struct Level {
    uint32_t width;
    uint32_t height;
    std::vector<glm::vec4> texels;
};

// Linear texels of one level, a row at a time: the largest level never stands in memory as floats.
struct Rows {
    uint32_t width;
    uint32_t height;
    std::function<void(size_t y, glm::vec4* row)> read;
};

// The common case, where both sides are even: the mean of four.
Level halve_evenly(const Rows& level) {
    Level half{level.width / 2, level.height / 2, {}};
    half.texels.reserve(static_cast<size_t>(half.width) * half.height);
    std::vector<glm::vec4> pair(size_t{2} * level.width);
    for (size_t y = 0; y < half.height; ++y) {
        const glm::vec4* upper = pair.data();
        const glm::vec4* lower = upper + level.width;
        level.read(2 * y, pair.data());
        level.read(2 * y + 1, pair.data() + level.width);
        for (size_t x = 0; x < half.width; ++x, upper += 2, lower += 2) {
            half.texels.push_back(0.25f * ((upper[0] + upper[1]) + (lower[0] + lower[1])));
        }
    }
    return half;
}

// Calls add(j, share) for what output i of `to` covers of `from` inputs: [i * from / to, (i + 1) * from / to), in units
// of 1 / to of an input, so that all borders are whole numbers. The shares' sum is `from`.
template <class Add>
void cover(uint64_t i, uint64_t from, uint64_t to, Add&& add) {
    const uint64_t begin = i * from, end = begin + from;
    for (uint64_t j = begin / to; j * to < end; ++j) {
        add(j, static_cast<double>(std::min(end, (j + 1) * to) - std::max(begin, j * to)));
    }
}

// Along the rows first, then across them. With an even side this is the plain mean of two.
Level halve(const Rows& level) {
    if (level.width % 2 == 0 && level.height % 2 == 0) return halve_evenly(level);
    const uint32_t width = std::max(1u, level.width / 2);
    const uint32_t height = std::max(1u, level.height / 2);
    Level half{width, height, std::vector<glm::vec4>(static_cast<size_t>(width) * height)};
    std::vector<glm::vec4> row(level.width);
    std::vector<glm::dvec4> sums(width);
    for (uint32_t y = 0; y < height; ++y) {
        std::fill(sums.begin(), sums.end(), glm::dvec4(0.0));
        cover(y, level.height, height, [&](uint64_t j, double row_share) {
            level.read(j, row.data());
            for (uint32_t x = 0; x < width; ++x) {
                glm::dvec4 sum(0.0);
                cover(x, level.width, width, [&](uint64_t k, double share) { sum += share * glm::dvec4(row[k]); });
                sums[x] += row_share * glm::dvec4(glm::vec4(sum / static_cast<double>(level.width)));
            }
        });
        for (uint32_t x = 0; x < width; ++x) {
            half.texels[size_t{y} * width + x] = sums[x] / static_cast<double>(level.height);
        }
    }
    return half;
}

// A float texel as the format's own texels are once they are read.
glm::vec4 linear_texel(glm::vec4 texel, TexelFormat format) {
    if (format == TexelFormat::rgba8_srgb || format == TexelFormat::rgba16_srgb) {
        for (int i = 0; i < 3; ++i) texel[i] = srgb_to_linear(texel[i]);
    } else if (format == TexelFormat::rgb9e5) {
        texel = glm::vec4(unpack_rgb9e5(pack_rgb9e5(glm::vec3(texel))), 1.0f);  // clamped; NaN gone
    }
    return texel;
}

Rows rows_of(const Image& image, TexelFormat format) {
    return {image.width, image.height, [&image, format](size_t y, glm::vec4* row) {
                const size_t first = y * image.width;
                for (size_t x = 0; x < image.width; ++x) {
                    row[x] = image.bytes.empty() ? linear_texel(image.texel(first + x), format)
                                                 : unpack_texel(image.bytes[first + x], format);
                }
            }};
}

Rows rows_of(const Level& level) {
    return {level.width, level.height,
            [&level](size_t y, glm::vec4* row) { std::copy_n(&level.texels[y * level.width], level.width, row); }};
}

TexelFormat format_of(const Image& image, TextureRole role) {
    if (image.is_hdr) return TexelFormat::rgb9e5;
    const bool deep = image.bytes.empty();
    if (role == TextureRole::color) return deep ? TexelFormat::rgba16_srgb : TexelFormat::rgba8_srgb;
    return deep ? TexelFormat::rgba16 : TexelFormat::rgba8;
}

// Level 0 of an image that is not of bytes; 16 bits as they are in the file.
void append_finest(const Image& image, HostTexture& texture) {
    for (const glm::u16vec4& stored : image.shorts) {
        const glm::uvec2 words = pack_deep_texel(stored);
        texture.texels.insert(texture.texels.end(), {words.x, words.y});
    }
    for (const glm::vec4& stored : image.floats)
        append_texel(linear_texel(stored, texture.format), texture.format, texture.texels);
}

uint32_t full_chain_levels(uint32_t width, uint32_t height) {
    uint32_t levels = 1;
    while (std::max(width, height) >> levels) ++levels;
    return levels;
}

}  // namespace

glm::vec4 Image::texel(size_t i) const {
    if (!bytes.empty()) return unpack_texel(bytes[i], TexelFormat::rgba8);
    return shorts.empty() ? floats[i] : glm::vec4(shorts[i]) / 65535.0f;
}

HostTexture build_texture(Image image, TextureRole role, bool with_mips) {
    HostTexture texture;
    texture.width = image.width;
    texture.height = image.height;
    texture.levels = with_mips ? full_chain_levels(image.width, image.height) : 1;
    texture.format = format_of(image, role);
    Level level{};
    if (texture.levels > 1) level = halve(rows_of(image, texture.format));
    size_t chain = 0;
    for (uint32_t i = 0; i < texture.levels; ++i)
        chain += size_t{std::max(1u, image.width >> i)} * std::max(1u, image.height >> i);
    texture.texels = std::move(image.bytes);
    texture.texels.reserve(chain * texel_words(texture.format));
    if (texture.texels.empty()) append_finest(image, texture);
    give_back(image.shorts);
    give_back(image.floats);
    for (uint32_t i = 1; i < texture.levels; ++i) {
        if (i > 1) level = halve(rows_of(level));
        for (const glm::vec4& texel : level.texels) append_texel(texel, texture.format, texture.texels);
    }
    return texture;
}

glm::vec3 mean_color(const HostTexture& texture) {
    const size_t count = static_cast<size_t>(texture.width) * texture.height;
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < count; ++i) sum += glm::dvec3(texel_at(texture.texels, i, texture.format));
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

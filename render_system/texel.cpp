// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/texel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace render_system {

namespace {

std::array<float, 256> make_srgb_table() {
    std::array<float, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) table[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
    return table;
}

// Also takes NaN to 0: every comparison with it is false.
float saturate(float x) { return x > 0.0f ? std::min(x, 1.0f) : 0.0f; }

uint32_t to_byte(float x) { return static_cast<uint32_t>(saturate(x) * 255.0f + 0.5f); }

}  // namespace

float srgb_to_linear(float encoded) {
    const double x = encoded;
    return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

float linear_to_srgb(float linear) {
    const double x = linear;
    return static_cast<float>(x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}

uint32_t pack_rgb9e5(const glm::vec3& color) {
    // Names follow the extension's text: N mantissa bits, B the exponent's bias.
    constexpr int N = 9;
    constexpr int B = 15;
    glm::vec3 c;
    for (int i = 0; i < 3; ++i) c[i] = color[i] > 0.0f ? std::min(color[i], RGB9E5_MAX) : 0.0f;
    const float largest = std::max(c.x, std::max(c.y, c.z));
    int exponent = 0;
    if (largest > 0.0f) exponent = std::max(-B - 1, std::ilogb(largest)) + 1 + B;
    // Rounding the largest component may carry into the next exponent.
    if (std::floor(std::ldexp(largest, N + B - exponent) + 0.5f) >= static_cast<float>(1 << N)) ++exponent;
    uint32_t texel = static_cast<uint32_t>(exponent) << 27;
    for (int i = 0; i < 3; ++i) {
        texel |= static_cast<uint32_t>(std::floor(std::ldexp(c[i], N + B - exponent) + 0.5f)) << (N * i);
    }
    return texel;
}

glm::vec3 unpack_rgb9e5(uint32_t texel) {
    const int exponent = static_cast<int>(texel >> 27) - 15 - 9;
    const auto component = [&](int i) { return std::ldexp(static_cast<float>((texel >> (9 * i)) & 0x1FFu), exponent); };
    return {component(0), component(1), component(2)};
}

uint32_t pack_texel(const glm::vec4& linear, TexelFormat format) {
    if (format == TexelFormat::rgb9e5) return pack_rgb9e5(glm::vec3(linear));
    glm::vec4 v = linear;
    if (format == TexelFormat::rgba8_srgb) {
        for (int i = 0; i < 3; ++i) v[i] = linear_to_srgb(saturate(v[i]));
    }
    return to_byte(v.x) | to_byte(v.y) << 8 | to_byte(v.z) << 16 | to_byte(v.w) << 24;
}

glm::vec4 unpack_texel(uint32_t texel, TexelFormat format) {
    static const std::array<float, 256> srgb = make_srgb_table();
    if (format == TexelFormat::rgb9e5) return glm::vec4(unpack_rgb9e5(texel), 1.0f);
    const uint32_t r = texel & 0xFFu, g = texel >> 8 & 0xFFu, b = texel >> 16 & 0xFFu;
    const float alpha = static_cast<float>(texel >> 24) / 255.0f;
    if (format == TexelFormat::rgba8_srgb) return {srgb[r], srgb[g], srgb[b], alpha};
    return {static_cast<float>(r) / 255.0f, static_cast<float>(g) / 255.0f, static_cast<float>(b) / 255.0f, alpha};
}

glm::uvec2 pack_deep_texel(const glm::u16vec4& stored) {
    return {uint32_t{stored.x} | uint32_t{stored.y} << 16, uint32_t{stored.z} | uint32_t{stored.w} << 16};
}

glm::u16vec4 deep_texel(const glm::vec4& linear, TexelFormat format) {
    glm::u16vec4 stored;
    for (int i = 0; i < 4; ++i) {
        const float value = saturate(linear[i]);
        const float curved = format == TexelFormat::rgba16_srgb && i < 3 ? linear_to_srgb(value) : value;
        stored[i] = static_cast<uint16_t>(curved * 65535.0f + 0.5f);
    }
    return stored;
}

void append_texel(const glm::vec4& linear, TexelFormat format, std::vector<uint32_t>& texels) {
    if (texel_words(format) == 1) {
        texels.push_back(pack_texel(linear, format));
        return;
    }
    const glm::uvec2 words = pack_deep_texel(deep_texel(linear, format));
    texels.insert(texels.end(), {words.x, words.y});
}

glm::vec4 texel_at(std::span<const uint32_t> texels, size_t i, TexelFormat format) {
    if (texel_words(format) == 1) return unpack_texel(texels[i], format);
    const uint32_t low = texels[2 * i], high = texels[2 * i + 1];
    glm::vec4 texel = glm::vec4(low & 0xFFFFu, low >> 16, high & 0xFFFFu, high >> 16) / 65535.0f;
    for (int c = 0; c < 3 && format == TexelFormat::rgba16_srgb; ++c) texel[c] = srgb_to_linear(texel[c]);
    return texel;
}

}  // namespace render_system

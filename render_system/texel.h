// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render_system/core_data.h"

namespace render_system {

/// The sRGB curve of IEC 61966-2-1, from the stored value to linear light and back; both in 0 to 1.
float srgb_to_linear(float encoded);
float linear_to_srgb(float linear);

/// The largest value that rgb9e5 can hold.
constexpr float RGB9E5_MAX = 65408.0f;

/// Packs as the specification of EXT_texture_shared_exponent does: to nearest, clamped to 0 and RGB9E5_MAX; NaN is 0.
uint32_t pack_rgb9e5(const glm::vec3& color);
glm::vec3 unpack_rgb9e5(uint32_t texel);

/// Packs linear values as a texel of that format of one word; 8-bit formats round to nearest, values outside 0 to 1 are
/// clamped.
uint32_t pack_texel(const glm::vec4& linear, TexelFormat format);

/// The linear values that a texel of one word stands for.
glm::vec4 unpack_texel(uint32_t texel, TexelFormat format);

/// The two words of a texel of 16 bits a channel, as stored.
glm::uvec2 pack_deep_texel(const glm::u16vec4& stored);

/// Linear values as a texel of that format, rounded to nearest, clamped to 0 to 1, as stored.
glm::u16vec4 deep_texel(const glm::vec4& linear, TexelFormat format);

/// Appends the words of a texel of any format.
void append_texel(const glm::vec4& linear, TexelFormat format, std::vector<uint32_t>& texels);

/// The linear values of texel `i`, of any format.
glm::vec4 texel_at(std::span<const uint32_t> texels, size_t i, TexelFormat format);

}  // namespace render_system

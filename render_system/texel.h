// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

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

/// Packs linear values as a texel of that format; 8-bit formats round to nearest, values outside 0 to 1 are clamped.
uint32_t pack_texel(const glm::vec4& linear, TexelFormat format);

/// The linear values that a texel stands for.
glm::vec4 unpack_texel(uint32_t texel, TexelFormat format);

}  // namespace render_system

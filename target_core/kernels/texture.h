// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/texture.glsl.
#pragma once

#include "target_core/kernels/buffers.h"
#include "target_core/kernels/math.h"

namespace target_core::kernels {

// Texture coordinates at a point, and how many of them one ray cone covers there.
struct TextureCoordinates {
    vec2 uv0;
    vec2 uv1;
    Float footprint0;  // squared: uv area under the cone's cross section, before the texture's size
    Float footprint1;
    vec2 uv2;
    vec2 uv3;
    Float footprint2;
    Float footprint3;
};

// The sRGB curve: IEC 61966-2-1. s^2.4 is t^4 * t^0.8 with t = sqrt(s) and a polynomial for t^0.8: within 2.5e-6.
inline Float linear_from_srgb(Float c) {
    Float s = (c + 0.055f) * 0.947867299f;
    Float t = sqrt(s);
    Float p = -0.0575114973f;
    p = p * t + 0.238568604f;
    p = p * t - 0.45529449f;
    p = p * t + 1.22464502f;
    p = p * t + 0.0495898798f;
    return select(c <= 0.04045f, c * 0.0773993808f, s * s * p);
}

inline Float unorm8(Uint byte_value) { return Float(byte_value) * 0.00392156863f; }

inline vec4 decode_texel(Uint bits, Uint format) {
    vec4 color = vec4(unorm8(bits & RGBA8_MASK), unorm8((bits >> RGBA8_GREEN_SHIFT) & RGBA8_MASK),
                      unorm8((bits >> RGBA8_BLUE_SHIFT) & RGBA8_MASK), unorm8(bits >> RGBA8_ALPHA_SHIFT));
    if (any_lane(format == TEXEL_RGBA8_SRGB)) {
        vec4 curved = vec4(linear_from_srgb(color.x), linear_from_srgb(color.y), linear_from_srgb(color.z), color.w);
        color = select(format == TEXEL_RGBA8_SRGB, curved, color);
    }
    if (any_lane(format == TEXEL_RGB9E5)) {
        Float scale =
            uintBitsToFloat(((bits >> RGB9E5_EXPONENT_SHIFT) + RGB9E5_FLOAT_EXPONENT) << FLOAT_EXPONENT_SHIFT);
        vec4 shared_exponent =
            vec4(Float(bits & RGB9E5_MASK) * scale, Float((bits >> RGB9E5_GREEN_SHIFT) & RGB9E5_MASK) * scale,
                 Float((bits >> RGB9E5_BLUE_SHIFT) & RGB9E5_MASK) * scale, 1.0f);
        color = select(format == TEXEL_RGB9E5, shared_exponent, color);
    }
    return color;
}

inline Float unorm16(Uint short_value) { return Float(short_value) * 1.52590219e-5f; }

inline vec4 decode_deep_texel(Uint low, Uint high, Uint format) {
    vec4 color = vec4(unorm16(low & RGBA16_MASK), unorm16(low >> RGBA16_SHIFT), unorm16(high & RGBA16_MASK),
                      unorm16(high >> RGBA16_SHIFT));
    vec4 curved = vec4(linear_from_srgb(color.x), linear_from_srgb(color.y), linear_from_srgb(color.z), color.w);
    return select(format == TEXEL_RGBA16_SRGB, curved, color);
}

// The texel that stands so many texels behind the first word of its level.
inline vec4 fetch_color(Uint first, Uint texel, Uint format) {
    vec4 color = decode_texel(fetch_texels(first + texel), format);
    if (has_feature(FEATURE_DEEP_TEXELS)) {
        Mask deep = format >= TEXEL_RGBA16;
        if (any_lane(deep)) {
            Uint low = first + select(deep, texel * 2u, texel);
            Uint high = select(deep, low + 1u, low);
            color = select(deep, decode_deep_texel(fetch_texels(low), fetch_texels(high), format), color);
        }
    }
    return color;
}

// A coordinate brought to [0, 1) or [0, 1] by its wrap mode.
inline Float wrap_coordinate(Float u, Uint wrap) {
    Float repeated = u - floor(u);
    Float half_turns = u * 0.5f;
    Float folded = 1.0f - abs(1.0f - 2.0f * (half_turns - floor(half_turns)));
    Float clamped = saturate(u);
    return select(wrap == WRAP_REPEAT, repeated, select(wrap == WRAP_MIRRORED_REPEAT, folded, clamped));
}

// A texel's number that is at most one past either end, brought inside.
inline Uint wrap_texel(Int i, Int size, Uint wrap) {
    Mask repeats = wrap == WRAP_REPEAT;
    Int below = select(repeats, size - 1, Int(0));
    Int above = select(repeats, Int(0), size - 1);
    return Uint(select(i < 0, below, select(i >= size, above, i)));
}

// One level with bilinear interpolation.
inline vec4 sample_level(uvec4 header, Uint level, vec2 uv) {
    uvec4 size = fetch_textures(header.w + level);
    Uint format = header.x & TEXTURE_FIELD_MASK;
    Uint wrap_s = (header.x >> TEXTURE_WRAP_S_SHIFT) & TEXTURE_FIELD_MASK;
    Uint wrap_t = (header.x >> TEXTURE_WRAP_T_SHIFT) & TEXTURE_FIELD_MASK;
    Mask nearest = (header.x >> TEXTURE_NEAREST_SHIFT) != 0u;
    Float x = wrap_coordinate(uv.x, wrap_s) * Float(size.y) - 0.5f;
    Float y = wrap_coordinate(uv.y, wrap_t) * Float(size.z) - 0.5f;
    Float left = floor(x);
    Float top = floor(y);
    Float fraction_x = select(nearest, floor((x - left) + 0.5f), x - left);
    Float fraction_y = select(nearest, floor((y - top) + 0.5f), y - top);
    Uint x0 = wrap_texel(Int(left), Int(size.y), wrap_s);
    Uint x1 = wrap_texel(Int(left) + 1, Int(size.y), wrap_s);
    Uint row0 = wrap_texel(Int(top), Int(size.z), wrap_t) * size.y;
    Uint row1 = wrap_texel(Int(top) + 1, Int(size.z), wrap_t) * size.y;
    vec4 upper = blend(fetch_color(size.x, row0 + x0, format), fetch_color(size.x, row0 + x1, format), fraction_x);
    vec4 lower = blend(fetch_color(size.x, row1 + x0, format), fetch_color(size.x, row1 + x1, format), fraction_x);
    return blend(upper, lower, fraction_y);
}

// A texture at uv. `footprint` is the squared footprint in uv; 0 reads the finest level.
inline vec4 sample_texture(Uint texture_id, vec2 uv, Float footprint) {
    uvec4 header = fetch_textures(texture_id);
    Float texels = max(footprint * uintBitsToFloat(header.y), 1.0f);
    Float level = min(0.5f * log_2(min(texels, 1.0e30f)), Float(header.z) - 1.0f);
    Float finer = floor(level);
    Float fraction = level - finer;
    vec4 color = sample_level(header, Uint(finer), uv);
    if (any_lane(fraction > 0.0f)) {
        vec4 coarser = sample_level(header, min(Uint(finer) + 1u, header.z - 1u), uv);
        color = select(fraction > 0.0f, blend(color, coarser, fraction), color);
    }
    return color;
}

// What a material's texture slot reads; white for an empty slot.
inline vec4 sample_slot(Uint slot, TextureCoordinates at) {
    Mask used = slot != NONE;
    vec4 color = vec4(1.0f);
    if (any_lane(used)) {
        Rows rows = rows_from(select(used, slot, Uint(0u)) * SLOT_ROWS);
        vec4 row_u = fetch_texture_slots(rows, SLOT_U);
        vec4 row_v = fetch_texture_slots(rows, SLOT_V);
        Uint set = floatBitsToUint(row_v.w);
        Mask second = set == 1u;
        vec2 uv = select(second, at.uv1, at.uv0);
        Float covered = select(second, at.footprint1, at.footprint0);
        if (has_feature(FEATURE_MORE_UV)) {
            uv = select(set == 2u, at.uv2, select(set == 3u, at.uv3, uv));
            covered = select(set == 2u, at.footprint2, select(set == 3u, at.footprint3, covered));
        }
        Float area = abs(row_u.x * row_v.y - row_u.y * row_v.x);
        Float footprint = covered * area;
        vec2 moved = vec2((row_u.x * uv.x + row_u.y * uv.y) + row_u.z, (row_v.x * uv.x + row_v.y * uv.y) + row_v.z);
        color = select(used, sample_texture(floatBitsToUint(row_u.w), moved, footprint), color);
    }
    return color;
}

}  // namespace target_core::kernels

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/alpha.glsl.
#pragma once

#include "target_core/kernels/material.h"
#include "target_core/kernels/random.h"

namespace target_core::kernels {

// What separates the hashed decisions of a path's rays from each other.
const uint RAY_EXTENSION = 0u;
const uint RAY_SHADOW = 1u;

inline Uint ray_key(Uint path, uint kind) {
    Uint key = 0u;
    if (has_feature(FEATURE_ALPHA)) {
        Uint stream = pixel_seed(path + pass.first_pixel, settings.seed);
        key = hash_pair(stream, hash_pair(pass.sample_index, pass.segment * 2u + kind));
    }
    return key;
}

// Coverage of a triangle whose alpha comes from a texture or from vertex colours; 0 or 1 under a cutoff.
inline Float textured_coverage(Uint instance, Uint primitive, Float u, Float v) {
    vec4 mesh_row = fetch_instances(rows_from(instance * INSTANCE_ROWS), INSTANCE_MESH);
    uvec4 corners = fetch_corners(mesh_row, primitive);
    Attributes attributes = fetch_attributes(corners, floatBitsToUint(mesh_row.z), u, v);
    Rows rows = rows_from(corners.w * MATERIAL_ROWS);
    vec4 base_color = fetch_materials(rows, MATERIAL_BASE_COLOR);
    vec4 alpha = fetch_materials(rows, MATERIAL_ALPHA);
    vec4 slots = fetch_materials(rows, MATERIAL_SLOTS);
    TextureCoordinates at;
    at.uv0 = attributes.uv0;
    at.uv1 = attributes.uv1;
    at.footprint0 = 0.0f;
    at.footprint1 = 0.0f;
    if (has_feature(FEATURE_MORE_UV)) {
        at.uv2 = attributes.uv2;
        at.uv3 = attributes.uv3;
        at.footprint2 = 0.0f;
        at.footprint3 = 0.0f;
    }
    Float coverage = base_color.w * attributes.color.w * sample_slot(floatBitsToUint(slots.x), at).w;
    Float passed = select(coverage >= alpha.y, Float(1.0f), Float(0.0f));
    coverage = select(alpha.y > 0.0f, passed, coverage);
    return select((floatBitsToUint(alpha.z) & MATERIAL_OPAQUE) != 0u, Float(1.0f), coverage);
}

// Whether a ray meets a triangle that it crosses, or passes through. A hashed decision, so that it does not depend
// on the order in which triangles are visited. opacity: 1 opaque, [0, 1) constant coverage, negative: textured.
inline Mask meets_surface(Float opacity, Uint key, Uint instance, Uint primitive, Float u, Float v) {
    Float coverage = opacity;
    if (has_feature(FEATURE_ALPHA_TEXTURES)) {
        if (any_lane(opacity < 0.0f)) {
            coverage = select(opacity < 0.0f, textured_coverage(instance, primitive, u, v), opacity);
        }
    }
    return unit_float(hash_pair(key, hash_pair(instance, primitive))) < coverage;
}

}  // namespace target_core::kernels

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/sky.h.
#ifndef SKY_GLSL
#define SKY_GLSL

#include "buffers.glsl"
#include "math.glsl"

// The map is equirectangular, row 0 at +y; -z is its centre.

vec2 sky_coordinates(vec3 direction) {
    Float u = 0.5f + arc_tangent(direction.x, -direction.z) * (0.5f * INVERSE_PI);
    Float v = arc_cosine(clamp(direction.y, -1.0f, 1.0f)) * INVERSE_PI;
    return vec2(saturate(u), saturate(v));
}

vec3 sky_direction(vec2 coordinates) {
    vec2 around = cos_sin_turns(min(coordinates.x, 0.99999994f));
    vec2 polar = cos_sin_turns(coordinates.y * 0.5f);
    // u = 0.5 looks along -z, and u grows towards +x.
    return vec3(-around.y * polar.y, polar.x, around.x * polar.y);
}

vec3 sky_map_radiance(vec2 coordinates) {
    Float x = coordinates.x * float(settings.sky_width) - 0.5f;
    Float y = coordinates.y * float(settings.sky_height) - 0.5f;
    Float left = floor(x);
    Float top = floor(y);
    Int last_column = Int(settings.sky_width) - 1;
    Int last_row = Int(settings.sky_height) - 1;
    Int x0 = Int(left);
    Int x1 = Int(left) + 1;
    Uint column0 = Uint(select(x0 < 0, last_column, x0));
    Uint column1 = Uint(select(x1 > last_column, Int(0), x1));
    Uint row0 = Uint(max(Int(top), Int(0))) * settings.sky_width;
    Uint row1 = Uint(min(Int(top) + 1, last_row)) * settings.sky_width;
    vec3 upper = blend(vec3(fetch_sky_texels(row0 + column0)), vec3(fetch_sky_texels(row0 + column1)), x - left);
    vec3 lower = blend(vec3(fetch_sky_texels(row1 + column0)), vec3(fetch_sky_texels(row1 + column1)), x - left);
    return blend(upper, lower, y - top);
}

// Density per solid angle of choosing a direction through sky_table, given the probability of its texel.
Float sky_density(Float probability, Float v) {
    Float sine = cos_sin_turns(min(v * 0.5f, 0.5f)).y;
    return probability * float(settings.sky_width) * float(settings.sky_height) / (TWO_PI_SQUARED * max(sine, 1.0e-6f));
}

struct SkyLookup {
    vec3 radiance;
    Float pdf;  // per solid angle, of choosing this direction as a light sample; 0: never chosen
};

SkyLookup look_up_sky(vec3 direction) {
    SkyLookup sky;
    sky.radiance = vec3(settings.sky_radiance);
    sky.pdf = 0.0f;
    if (has_feature(FEATURE_SKY_MAP)) {
        vec2 coordinates = sky_coordinates(direction);
        Uint column = min(Uint(coordinates.x * float(settings.sky_width)), Uint(settings.sky_width - 1u));
        Uint row = min(Uint(coordinates.y * float(settings.sky_height)), Uint(settings.sky_height - 1u));
        vec4 texel = fetch_sky_texels(row * settings.sky_width + column);
        sky.radiance = sky_map_radiance(coordinates);
        sky.pdf = settings.sky_light_probability * sky_density(texel.w, coordinates.y);
    }
    return sky;
}

#endif

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/lights.h.
#ifndef LIGHTS_GLSL
#define LIGHTS_GLSL

#include "random.glsl"
#include "sky.glsl"
#include "texture.glsl"

const float FAR_AWAY = 1.0e30f;

// One direction to one light as seen from a point.
struct LightSample {
    vec3 direction;  // unit, towards the light
    Float distance;  // to the light
    vec3 radiance;   // arriving; divided by the squared distance for point lights
    Float pdf;       // per solid angle, with the choice of the light; of the choice alone for a delta light
    Mask is_delta;   // no ray finds this light by chance
};

// Walker's alias method: entry from the first number, own or alias from the second.
Uint pick_from(Uint entry, vec4 row, Float fraction) { return select(fraction < row.x, entry, floatBitsToUint(row.y)); }

Uint entry_of(Float u, uint count) { return min(Uint(u * float(count)), Uint(count - 1u)); }

// Uniform point in a triangle: Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
vec2 sample_triangle(vec2 u) {
    Mask upper = u.y > u.x;
    Float x = select(upper, u.x * 0.5f, u.x - u.y * 0.5f);
    Float y = select(upper, u.y - u.x * 0.5f, u.y * 0.5f);
    return vec2(x, y);
}

LightSample sample_triangle_light(Rows rows, vec3 from, vec2 u) {
    vec4 position_row = fetch_lights(rows, LIGHT_POSITION);
    vec4 vertex1_row = fetch_lights(rows, LIGHT_VERTEX1);
    vec4 vertex2_row = fetch_lights(rows, LIGHT_VERTEX2);
    vec4 emission_row = fetch_lights(rows, LIGHT_EMISSION);
    vec2 b = sample_triangle(u);
    vec3 edge1 = vec3(vertex1_row) - vec3(position_row);
    vec3 edge2 = vec3(vertex2_row) - vec3(position_row);
    vec3 way = ((vec3(position_row) + edge1 * b.x) + edge2 * b.y) - from;
    Float distance_squared = max(dot(way, way), SMALLEST);
    LightSample light;
    light.distance = sqrt(distance_squared);
    light.direction = way * (1.0f / light.distance);
    Float facing = -dot(cross(edge1, edge2), light.direction);  // cosine times twice the area
    Mask two_sided = floatBitsToUint(vertex1_row.w) != 0u;
    Mask shines = facing > 0.0f || two_sided;
    light.pdf = vertex2_row.w * distance_squared / max(abs(facing), SMALLEST);
    light.radiance = select(shines, vec3(emission_row), vec3(0.0f));
    light.is_delta = false;
    if (has_feature(FEATURE_EMISSION_TEXTURES)) {
        Uint texture_id = floatBitsToUint(emission_row.w);
        if (any_lane(texture_id != NONE)) {
            vec4 uv01 = fetch_lights(rows, LIGHT_UV01);
            vec4 uv2 = fetch_lights(rows, LIGHT_UV2);
            Float w = (1.0f - b.x) - b.y;
            vec2 uv = (vec2(uv01.x, uv01.y) * w + vec2(uv01.z, uv01.w) * b.x) + vec2(uv2.x, uv2.y) * b.y;
            vec3 texel = vec3(sample_texture(select(texture_id != NONE, texture_id, Uint(0u)), uv, 0.0f));
            light.radiance = light.radiance * select(texture_id != NONE, texel, vec3(1.0f));
        }
    }
    return light;
}

// Point, spot and directional lights of KHR_lights_punctual.
LightSample sample_punctual_light(Rows rows, Uint kind, vec3 from) {
    vec4 position_row = fetch_lights(rows, LIGHT_POSITION);
    vec4 axis_row = fetch_lights(rows, LIGHT_VERTEX1);
    vec4 cone_row = fetch_lights(rows, LIGHT_VERTEX2);
    vec4 emission_row = fetch_lights(rows, LIGHT_EMISSION);
    vec3 way = vec3(position_row) - from;
    Float distance_squared = max(dot(way, way), SMALLEST);
    Mask directional = kind == LIGHT_DIRECTIONAL;
    LightSample light;
    light.distance = select(directional, Float(FAR_AWAY), sqrt(distance_squared));
    light.direction = select(directional, -vec3(axis_row), way * (1.0f / sqrt(distance_squared)));
    Float cosine = -dot(vec3(axis_row), light.direction);
    Float inside = square(saturate(cosine * cone_row.x + cone_row.y));
    Float falloff = select(directional, Float(1.0f), 1.0f / distance_squared);
    light.radiance = vec3(emission_row) * (falloff * select(kind == LIGHT_SPOT, inside, Float(1.0f)));
    light.pdf = 1.0f;
    light.is_delta = true;
    return light;
}

LightSample sample_sky_light(vec2 u, vec2 pick) {
    Float entries = pick.x * float(settings.sky_width * settings.sky_height);
    Uint entry = min(Uint(entries), Uint(settings.sky_width * settings.sky_height - 1u));
    Uint texel = pick_from(entry, fetch_sky_table(entry), pick.y);
    Uint row = texel / settings.sky_width;
    Uint column = texel - row * settings.sky_width;
    vec2 coordinates =
        vec2((Float(column) + u.x) / float(settings.sky_width), (Float(row) + u.y) / float(settings.sky_height));
    LightSample light;
    light.direction = sky_direction(coordinates);
    light.distance = FAR_AWAY;
    light.radiance = sky_map_radiance(coordinates);
    light.pdf = sky_density(fetch_sky_texels(texel).w, coordinates.y);
    light.is_delta = false;
    return light;
}

// Chooses a light by its power, then a point on it, as seen from `from`.
LightSample sample_light(vec3 from, Uint stream, uint sample_index, uint first_pair) {
    vec2 u = random_pair(stream, sample_index, first_pair + PAIR_LIGHT);
    vec2 pick = random_pair(stream, sample_index, first_pair + PAIR_LIGHT_PICK);
    Uint entry = entry_of(pick.x, settings.light_count);
    Uint chosen = pick_from(entry, fetch_light_table(entry), pick.y);
    Rows rows = rows_from(chosen * LIGHT_ROWS);
    Uint kind = floatBitsToUint(fetch_lights(rows, LIGHT_POSITION).w);
    LightSample light = sample_triangle_light(rows, from, u);
    if (has_feature(FEATURE_PUNCTUAL_LIGHTS)) {
        Mask punctual = kind == LIGHT_POINT || kind == LIGHT_SPOT || kind == LIGHT_DIRECTIONAL;
        LightSample other = sample_punctual_light(rows, kind, from);
        light.direction = select(punctual, other.direction, light.direction);
        light.distance = select(punctual, other.distance, light.distance);
        light.radiance = select(punctual, other.radiance, light.radiance);
        light.pdf = select(punctual, fetch_light_table(chosen).z, light.pdf);
        light.is_delta = punctual;
    }
    if (has_feature(FEATURE_SKY_MAP)) {
        Mask sky = kind == LIGHT_SKY;
        LightSample other = sample_sky_light(u, random_pair(stream, sample_index, first_pair + PAIR_SKY_PICK));
        light.direction = select(sky, other.direction, light.direction);
        light.distance = select(sky, other.distance, light.distance);
        light.radiance = select(sky, other.radiance, light.radiance);
        light.pdf = select(sky, fetch_light_table(chosen).z * other.pdf, light.pdf);
    }
    return light;
}

#endif

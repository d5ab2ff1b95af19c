// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/material.glsl.
#pragma once

#include "target_core/kernels/surface.h"

namespace target_core::kernels {

// A material where a ray met it: factors times textures, in the metallic-roughness model of glTF 2.0.
struct Material {
    vec3 base_color;
    Float metallic;
    Float roughness;
    Float specular;
    Float transmission;
    vec3 specular_color;
    Float ior;
    vec3 emission;
    Float emission_weight;
    Uint flags;
    Uint energy_row;
    vec3 sheen_color;
    Float sheen_roughness;
    Uint sheen_row;
    Float coat;
    Float coat_roughness;
    Float film;
    Float film_ior;
    Float film_thickness;  // nanometres
    Float anisotropy;
    vec2 stretch;  // where the lobe is stretched to, along tangent and bitangent
    Uint stretched_row;
};

inline Material fetch_material(Surface surface) {
    Rows rows = rows_from(surface.material * MATERIAL_ROWS);
    vec4 base_color = fetch_materials(rows, MATERIAL_BASE_COLOR);
    vec4 factors = fetch_materials(rows, MATERIAL_SURFACE);
    vec4 emission = fetch_materials(rows, MATERIAL_EMISSION);
    vec4 specular = fetch_materials(rows, MATERIAL_SPECULAR);
    vec4 alpha = fetch_materials(rows, MATERIAL_ALPHA);
    Material material;
    material.base_color = vec3(base_color) * vec3(surface.color);
    material.metallic = factors.x;
    material.roughness = factors.y;
    material.specular = factors.z;
    material.transmission = factors.w;
    material.specular_color = vec3(specular);
    material.ior = specular.w;
    material.emission = vec3(emission);
    material.emission_weight = emission.w;
    material.flags = floatBitsToUint(alpha.z);
    material.energy_row = floatBitsToUint(alpha.w);
    if (has_feature(FEATURE_TEXTURES)) {
        vec4 slots = fetch_materials(rows, MATERIAL_SLOTS);
        vec4 surface_texel = sample_slot(floatBitsToUint(slots.y), surface.coordinates);
        material.base_color = material.base_color * vec3(sample_slot(floatBitsToUint(slots.x), surface.coordinates));
        material.roughness = material.roughness * surface_texel.y;
        material.metallic = material.metallic * surface_texel.z;
        if (has_feature(FEATURE_EMISSION_TEXTURES)) {
            material.emission = material.emission * vec3(sample_slot(floatBitsToUint(slots.w), surface.coordinates));
        }
        if (has_feature(FEATURE_SPECULAR_TEXTURES)) {
            vec4 more = fetch_materials(rows, MATERIAL_MORE_SLOTS);
            vec4 specular_color_texel = sample_slot(floatBitsToUint(more.z), surface.coordinates);
            material.transmission = material.transmission * sample_slot(floatBitsToUint(more.x), surface.coordinates).x;
            material.specular = material.specular * sample_slot(floatBitsToUint(more.y), surface.coordinates).w;
            material.specular_color = material.specular_color * vec3(specular_color_texel);
        }
    }
    if (has_feature(FEATURE_SHEEN)) {
        vec4 sheen = fetch_materials(rows, MATERIAL_SHEEN);
        material.sheen_color = vec3(sheen);
        material.sheen_roughness = sheen.w;
        material.sheen_row = floatBitsToUint(fetch_materials(rows, MATERIAL_LOBES).x);
        if (has_feature(FEATURE_LOBE_TEXTURES)) {
            Uint color_slot = floatBitsToUint(fetch_materials(rows, MATERIAL_MORE_SLOTS).w);
            Uint roughness_slot = floatBitsToUint(fetch_materials(rows, MATERIAL_LOBE_SLOTS).x);
            material.sheen_color = material.sheen_color * vec3(sample_slot(color_slot, surface.coordinates));
            material.sheen_roughness = material.sheen_roughness * sample_slot(roughness_slot, surface.coordinates).w;
        }
    }
    if (has_feature(FEATURE_FILM)) {
        vec4 film = fetch_materials(rows, MATERIAL_FILM);
        Float thick = 1.0f;
        material.film = film.x;
        material.film_ior = film.y;
        if (has_feature(FEATURE_LOBE_TEXTURES)) {
            vec4 slots = fetch_materials(rows, MATERIAL_FILM_SLOTS);
            material.film = material.film * sample_slot(floatBitsToUint(slots.x), surface.coordinates).x;
            thick = sample_slot(floatBitsToUint(slots.y), surface.coordinates).y;
        }
        material.film_thickness = blend(film.z, film.w, thick);
    }
    if (has_feature(FEATURE_ANISOTROPY)) {
        vec4 anisotropy = fetch_materials(rows, MATERIAL_ANISOTROPY);
        material.anisotropy = anisotropy.x;
        material.stretched_row = floatBitsToUint(anisotropy.y);
        material.stretch = vec2(anisotropy.z, anisotropy.w);
        if (has_feature(FEATURE_LOBE_TEXTURES)) {
            Uint slot = floatBitsToUint(fetch_materials(rows, MATERIAL_FILM_SLOTS).z);
            vec4 texel = sample_slot(slot, surface.coordinates);
            Float x = 2.0f * texel.x - 1.0f;
            Float y = 2.0f * texel.y - 1.0f;
            vec2 turned = vec2(anisotropy.z * x - anisotropy.w * y, anisotropy.w * x + anisotropy.z * y);
            material.anisotropy = material.anisotropy * texel.z;
            material.stretch = select(slot != NONE, turned, material.stretch);
        }
    }
    if (has_feature(FEATURE_COAT)) {
        vec4 lobes = fetch_materials(rows, MATERIAL_LOBES);
        material.coat = lobes.y;
        material.coat_roughness = lobes.z;
        if (has_feature(FEATURE_LOBE_TEXTURES)) {
            vec4 slots = fetch_materials(rows, MATERIAL_LOBE_SLOTS);
            material.coat = material.coat * sample_slot(floatBitsToUint(slots.y), surface.coordinates).x;
            material.coat_roughness =
                material.coat_roughness * sample_slot(floatBitsToUint(slots.z), surface.coordinates).y;
        }
    }
    return material;
}

// The shading normal, bent where the material has a normal map, on the front side.
inline vec3 shading_normal(Surface surface) {
    vec3 normal = surface.normal;
    if (has_feature(FEATURE_NORMAL_MAPS)) {
        Rows rows = rows_from(surface.material * MATERIAL_ROWS);
        vec4 slots = fetch_materials(rows, MATERIAL_SLOTS);
        vec4 alpha = fetch_materials(rows, MATERIAL_ALPHA);
        if (any_lane(floatBitsToUint(slots.z) != NONE)) {
            normal = bend_normal(surface, floatBitsToUint(slots.z), alpha.x);
        }
    }
    return normal;
}

// The normal of a coat, which the surface's own normal map does not bend.
inline vec3 coat_normal(Surface surface) {
    vec3 normal = surface.normal;
    if (has_feature(FEATURE_LOBE_TEXTURES)) {
        Rows rows = rows_from(surface.material * MATERIAL_ROWS);
        vec4 slots = fetch_materials(rows, MATERIAL_LOBE_SLOTS);
        vec4 lobes = fetch_materials(rows, MATERIAL_LOBES);
        if (any_lane(floatBitsToUint(slots.w) != NONE)) {
            normal = bend_normal(surface, floatBitsToUint(slots.w), lobes.w);
        }
    }
    return normal;
}

}  // namespace target_core::kernels

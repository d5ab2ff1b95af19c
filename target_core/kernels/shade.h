// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/shade.glsl.
#pragma once

#include "target_core/kernels/bsdf.h"
#include "target_core/kernels/lights.h"
#include "target_core/kernels/trace.h"

namespace target_core::kernels {

// Of light that went so far through the body of a solid, the share that is left: Beer and Lambert.
inline vec3 transmittance(Uint material, Float distance) {
    vec4 volume = fetch_materials(rows_from(material * MATERIAL_ROWS), MATERIAL_VOLUME);
    Float halvings = distance * -1.44269504f;
    return vec3(exp_2(max(volume.x * halvings, -126.0f)), exp_2(max(volume.y * halvings, -126.0f)),
                exp_2(max(volume.z * halvings, -126.0f)));
}

// The solid that the ray went through. A surface that is met from behind tells it as well, to rays that begin inside.
inline Uint medium_before(Rows path, Surface surface, Material material) {
    Mask is_solid = (material.flags & MATERIAL_THIN_WALLED) == 0u && material.transmission > 0.0f;
    return select(is_solid && !surface.front, surface.material + 1u, load_medium(path));
}

inline void shade_emission(Uint path, vec3 direction, Surface surface, Material material, Throughput throughput) {
    Mask double_sided = (material.flags & MATERIAL_DOUBLE_SIDED) != 0u;
    Mask shines = (surface.front || double_sided) && max_component(material.emission) > 0.0f;
    if (any_lane(shines)) {
        Float cosine = max(abs(dot(surface.geometric_normal, direction)), 1.0e-6f);
        Float density = material.emission_weight * settings.light_weight_scale;
        Float light_pdf = density * surface.distance_squared / cosine;
        add_radiance(path, throughput.weight * material.emission * found_by_chance(throughput, light_pdf), shines);
    }
}

// A surface point as scattering needs it: everything on the side that the ray comes from.
struct Scatterer {
    vec3 position;
    vec3 side;  // geometric normal, world space
    Frame frame;
    Bsdf bsdf;
};

inline Scatterer make_scatterer(Surface surface, Material material, vec3 direction) {
    vec3 towards = -direction;
    vec3 side = select(surface.front, surface.geometric_normal, -surface.geometric_normal);
    vec3 bent = shading_normal(surface);
    bent = select(surface.front, bent, -bent);
    // A shading normal that cannot be seen from here would put wo below the surface.
    vec3 normal = select(dot(bent, towards) > 1.0e-3f, bent, side);
    Scatterer scatterer;
    scatterer.position = surface.position;
    scatterer.side = side;
    scatterer.frame = frame_around(normal);
    if (has_feature(FEATURE_ANISOTROPY)) {
        Mask stretched = material.anisotropy > 0.0f;
        if (any_lane(stretched)) {
            vec3 along = select(stretched, stretched_along(surface, material.stretch), vec3(0.0f));
            scatterer.frame = frame_along(normal, along);
        }
    }
    vec3 wo = to_local(scatterer.frame, towards);
    wo = vec3(wo.x, wo.y, max(wo.z, 1.0e-6f));
    scatterer.bsdf = make_bsdf(material, wo, to_local(scatterer.frame, side), surface.front);
    if (has_feature(FEATURE_COAT)) {
        vec3 coat = coat_normal(surface);
        coat = select(surface.front, coat, -coat);
        coat = select(dot(coat, towards) > 1.0e-3f, coat, side);
        scatterer.bsdf = with_coat(scatterer.bsdf, material, to_local(scatterer.frame, coat));
    }
    return scatterer;
}

// The point to leave from in direction w.
inline vec3 leave_point(Scatterer scatterer, vec3 w) {
    return offset_point(scatterer.position, select(dot(scatterer.side, w) > 0.0f, scatterer.side, -scatterer.side));
}

// The solid that a path goes through once it left the surface in direction w.
inline Uint medium_behind(Scatterer scatterer, Surface surface, Uint medium, vec3 w) {
    Mask crosses = scatterer.bsdf.refracts && dot(scatterer.side, w) < 0.0f;
    return select(crosses, select(surface.front, surface.material + 1u, Uint(0u)), medium);
}

// Next event estimation: one light, weighted against the BSDF's own sampling; its ray goes to the shadow queue.
inline void estimate_next_event(Uint path, Scatterer scatterer, vec3 weight, Uint stream, uint first_pair) {
    LightSample light = sample_light(scatterer.position, stream, pass.sample_index, first_pair);
    BsdfValue bsdf = evaluate_bsdf(scatterer.bsdf, to_local(scatterer.frame, light.direction));
    // The power heuristic's share over the density, in one division.
    Float squares = light.pdf * light.pdf + bsdf.pdf * bsdf.pdf;
    Float share = select(light.is_delta, Float(1.0f), light.pdf);
    share = share / max(select(light.is_delta, light.pdf, squares), SMALLEST);
    vec3 contribution = weight * bsdf.value * light.radiance * share;
    Mask counts = light.pdf > 0.0f && max_component(contribution) > 0.0f;
    vec3 origin = leave_point(scatterer, light.direction);
    push_shadow_ray(vec4(origin, light.distance * 0.9999f), vec4(light.direction, uintBitsToFloat(path)),
                    vec4(limited(contribution, pass.segment + 1u), 0.0f), counts);
}

// Russian roulette from segment 4 on: the share of paths that live equals the largest component of the weight.
inline bool plays_roulette() { return settings.russian_roulette != 0u && pass.segment >= 3u; }

inline Float survival_probability(vec3 weight) { return clamp(max_component(weight), 0.05f, 1.0f); }

// Cone growth by scattering: mirrors keep the cone, rough surfaces open it.
inline Float cone_growth(Bsdf bsdf, BsdfSample bsdf_sample) {
    return select(bsdf_sample.pdf > 0.0f, 0.25f * max(bsdf.pick_diffuse, bsdf.alpha), Float(0.0f));
}

inline void continue_path(Uint path, Scatterer scatterer, Surface surface, PathRay path_ray, vec3 weight, Uint medium,
                          Uint stream, uint first_pair) {
    vec2 u = random_pair(stream, pass.sample_index, first_pair + PAIR_BSDF);
    Float lobe = random_pair(stream, pass.sample_index, first_pair + PAIR_LOBE).x;
    BsdfSample bsdf_sample = sample_bsdf(scatterer.bsdf, u, lobe);
    vec3 carried = weight * bsdf_sample.weight;
    Mask lives = bsdf_sample.valid && max_component(carried) > 0.0f;
    if (plays_roulette()) {
        Float survival = survival_probability(carried);
        lives = lives && random_pair(stream, pass.sample_index, first_pair + PAIR_LOBE).y < survival;
        carried = carried * (1.0f / survival);
    }
    vec3 direction = to_world(scatterer.frame, bsdf_sample.wi);
    PathRay next;
    next.ray.origin = leave_point(scatterer, direction);
    next.ray.direction = direction;
    next.cone_width = surface.cone_width;
    next.cone_spread = path_ray.cone_spread + cone_growth(scatterer.bsdf, bsdf_sample);
    Throughput onward;
    onward.weight = carried;
    onward.pdf = bsdf_sample.pdf;
    store_path(path, next, onward, lives);
    if (has_feature(FEATURE_VOLUME)) {
        store_medium(path, medium_behind(scatterer, surface, medium, direction), lives);
    }
    push_extension_ray(path, lives);
}

// What the ray of a job of the surface queue met.
inline Surface surface_of_job(uvec4 row, PathRay path_ray) {
    return make_surface(path_ray, row.y, fetch_triangle(row.y, row.z));
}

// What happens where a ray met a surface: emission, next event estimation and the next segment.
inline void shade_path(Uint job) {
    uvec4 row = load_surface_job(job);
    Uint path = row.x;
    Rows rows = rows_from(path);
    PathRay path_ray = load_path_ray(rows);
    Throughput throughput = load_throughput(rows);
    vec3 direction = path_ray.ray.direction;
    Surface surface = surface_of_job(row, path_ray);
    Material material = fetch_material(surface);
    Uint medium = 0u;
    if (has_feature(FEATURE_VOLUME)) {
        medium = medium_before(rows, surface, material);
        if (any_lane(medium != 0u)) {
            Uint absorbing = select(medium != 0u, medium - 1u, Uint(0u));
            vec3 left = transmittance(absorbing, sqrt(surface.distance_squared));
            throughput.weight = throughput.weight * select(medium != 0u, left, vec3(1.0f));
        }
    }
    shade_emission(path, direction, surface, material, throughput);
    if (settings.scene_extent.w > 0.0f && pass.segment == 2u) {
        Mask sharp = throughput.pdf == 0.0f || throughput.pdf > settings.scene_extent.w;
        throughput.weight = select(sharp, throughput.weight, vec3(0.0f));
    }
    if (pass.segment < settings.max_path_length) {
        Uint stream = pixel_seed(path + pass.first_pixel, settings.seed);
        uint first_pair = pass.segment * PAIRS_PER_VERTEX;
        Scatterer scatterer = make_scatterer(surface, material, direction);
        if (has_feature(FEATURE_LIGHTS) && settings.next_event_estimation != 0u) {
            estimate_next_event(path, scatterer, throughput.weight, stream, first_pair);
        }
        continue_path(path, scatterer, surface, path_ray, throughput.weight, medium, stream, first_pair);
    }
}

}  // namespace target_core::kernels

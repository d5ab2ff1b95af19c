// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/guide.glsl.
#pragma once

#include "target_core/kernels/motion.h"
#include "target_core/kernels/shade.h"

namespace target_core::kernels {

// How much of the light a surface gives back, colour by colour and whichever way; never nothing, for light is divided
// by it.
inline vec3 guide_albedo(Material material) {
    vec3 color = material.base_color;
    vec3 gloss = (vec3(1.0f) - color) * (0.04f * material.specular * (1.0f - material.metallic));
    return color + gloss + vec3(0.01f);
}

// How near a surface is to the plane of the eye: one over its distance from there, which is linear on the screen where
// a surface is flat. Where rays are parallel the distance itself is that.
inline Float nearness(vec3 way) {
    vec3 axis = normalized(cross(vec3(settings.screen_right), vec3(settings.screen_down)));
    Float distance = max(abs(dot(way, axis)), SMALLEST);
    return select(settings.lens_down.w > 0.0f, distance, 1.0f / distance);
}

// The first row of the layer that a ray belongs to: that of the first one, if it is as near and turned alike.
inline Uint layer_of(Uint pixel, vec3 normal, Float near) {
    vec4 first = load_guide(pixel, Uint(GUIDE_NORMAL));
    Float share = 1.0f / max(first.w, 1.0f);
    Float first_near = load_guide(pixel, Uint(GUIDE_ALBEDO)).w * share;
    vec3 bend = normal - vec3(first) * share;
    Mask alike = dot(bend, bend) < 0.3f && abs(near - first_near) < 0.05f * first_near;
    return select(first.w == 0.0f || alike, Uint(0u), Uint(GUIDE_LAYER));
}

// Before shade where a camera ray met a surface: adds up what a filter goes by.
inline void guide_path(Uint job) {
    uvec4 row = load_surface_job(job);
    Uint path = row.x;
    Rows rows = rows_from(path);
    PathRay path_ray = load_path_ray(rows);
    Surface surface = surface_of_job(row, path_ray);
    Material material = fetch_material(surface);
    vec3 normal = shading_normal(surface);
    normal = select(surface.front, normal, -normal);
    Float near = nearness(surface.position - path_ray.ray.origin);
    Uint pixel = path + pass.first_pixel;
    Uint layer = layer_of(pixel, normal, near);
    add_to_guide(pixel, layer + GUIDE_ALBEDO, vec4(guide_albedo(material), near), true);
    add_to_guide(pixel, layer + GUIDE_NORMAL, vec4(normal, 1.0f), true);
    if (settings.frame != 0u) {
        vec3 motion = motion_of(surface);
        add_to_guide(pixel, (layer >> 1) + GUIDE_MOTION, vec4(motion, 0.0f), true);
    }
}

}  // namespace target_core::kernels

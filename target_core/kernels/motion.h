// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/motion.glsl.
#pragma once

#include "target_core/kernels/surface.h"

namespace target_core::kernels {

// Where things were on the screen in the frame before, as far as views, transforms of instances and vertices tell.

// A camera as pixels are found by it.
struct Camera {
    vec3 eye;
    vec3 screen;
    vec3 right;
    vec3 down;
    Mask parallel;
};

inline Camera camera_now() {
    Camera camera;
    camera.eye = vec3(settings.eye);
    camera.screen = vec3(settings.screen);
    camera.right = vec3(settings.screen_right);
    camera.down = vec3(settings.screen_down);
    camera.parallel = Float(settings.lens_down.w) > 0.0f;
    return camera;
}

inline Camera camera_before() {
    Camera camera;
    camera.eye = vec3(settings.eye_before);
    camera.screen = vec3(settings.screen_before);
    camera.right = vec3(settings.screen_right_before);
    camera.down = vec3(settings.screen_down_before);
    camera.parallel = Float(settings.eye_before.w) > 0.0f;
    return camera;
}

// Column and row at which a camera sees what lies along `way` from its eye, in pixels, and how near that is, as
// nearness() has it; far outside of the picture, and infinitely near, what is behind the eye.
inline vec3 place_seen(Camera camera, vec3 way) {
    vec3 across = cross(camera.right, camera.down);
    vec3 ahead = select(camera.parallel, camera.screen + (camera.right + camera.down) * 0.5f, camera.screen);
    Float depth = dot(way, across) / dot(ahead, across);
    Mask seen = depth > 1.0e-12f;
    Float scale = select(seen, depth, Float(1.0f));
    vec3 on_screen = select(camera.parallel, way - ahead * scale, way * (1.0f / scale) - camera.screen);
    Float area = 1.0f / dot(across, across);
    Float middle = select(camera.parallel, Float(0.5f), Float(0.0f));
    Float x = dot(cross(on_screen, camera.down), across) * area + middle;
    Float y = dot(cross(camera.right, on_screen), across) * area + middle;
    Float distance = max(abs(dot(way, across)) * sqrt(area), SMALLEST);
    Float near = select(camera.parallel, distance, 1.0f / distance);
    vec3 place = vec3(x * float(settings.width), y * float(settings.height), near);
    return select(seen, place, vec3(-1.0e6f, -1.0e6f, 1.0e30f));
}

// A point of a surface as the matrix of its instance takes it to where it was: where it is now, or, of a mesh that has
// changed its shape, the same place between the corners of its triangle as they were.
inline vec3 shape_before(Surface surface) {
    Rows rows = rows_from(surface.instance * MOTION_ROWS);
    Uint first = floatBitsToUint(fetch_motions(rows, MOTION_SHAPE).x);
    Rows instance = rows_from(surface.instance * INSTANCE_ROWS);
    vec4 mesh_row = fetch_instances(instance, INSTANCE_MESH);
    uvec4 corners = fetch_mesh_triangles(floatBitsToUint(mesh_row.x) + surface.primitive);
    Mask deforms = first != 0u;
    vec3 v0 = vec3(fetch_motions(rows_from(select(deforms, first + corners.x, Uint(0u))), 0u));
    vec3 v1 = vec3(fetch_motions(rows_from(select(deforms, first + corners.y, Uint(0u))), 0u));
    vec3 v2 = vec3(fetch_motions(rows_from(select(deforms, first + corners.z, Uint(0u))), 0u));
    vec3 point = (v0 + (v1 - v0) * surface.u) + (v2 - v0) * surface.v;
    return select(deforms, point, surface.position);
}

// How far a point of a surface has come on the screen since the frame before, backwards, and how near it was.
inline vec3 motion_of(Surface surface) {
    vec3 before = surface.position;
    if (settings.motion >= INSTANCES_MOVE) {
        vec3 point = before;
        if (settings.motion == VERTICES_MOVE) {
            point = shape_before(surface);
        }
        Rows rows = rows_from(surface.instance * MOTION_ROWS);
        vec4 row0 = fetch_motions(rows, 0u);
        vec4 row1 = fetch_motions(rows, 1u);
        vec4 row2 = fetch_motions(rows, 2u);
        before = transform_point(row0, row1, row2, point);
    }
    vec3 now = place_seen(camera_now(), surface.position - vec3(settings.eye));
    vec3 then = place_seen(camera_before(), before - vec3(settings.eye_before));
    return vec3(then.x - now.x, then.y - now.y, then.z);
}

}  // namespace target_core::kernels

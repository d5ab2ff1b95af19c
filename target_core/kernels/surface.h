// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/surface.glsl.
#pragma once

#include "target_core/kernels/buffers.h"
#include "target_core/kernels/intersect.h"
#include "target_core/kernels/path_state.h"
#include "target_core/kernels/texture.h"

namespace target_core::kernels {

// Three vertices in world space, and the triangle's number in its mesh.
struct TriangleVertices {
    vec3 v0;
    vec3 v1;
    vec3 v2;
    Uint primitive;
};

// The attributes of one triangle's vertices at barycentric coordinates (u, v), in mesh space.
struct Attributes {
    vec3 normal;
    uvec4 tangents;  // of each vertex, in x, y and z
    vec4 color;
    vec2 uv0;
    vec2 uv1;
    Float uv_area0;  // twice the triangle's area in uv
    Float uv_area1;
    vec2 uv2;
    vec2 uv3;
    Float uv_area2;
    Float uv_area3;
};

// Of a vertex, by the flags of its instance.
inline Uint vertex_rows(Uint flags) {
    Uint coordinates = ((flags >> INSTANCE_UV_SHIFT) & 1u) + ((flags >> INSTANCE_MORE_UV_SHIFT) & 1u);
    return (coordinates + ((flags >> INSTANCE_COLORS_SHIFT) & 1u)) + 1u;
}

// White where a mesh has no colours.
inline vec4 vertex_color(Uint corner, Uint flags) {
    vec4 color = fetch_vertices(rows_from((corner + vertex_rows(flags)) - 1u), VERTEX_COLOR);
    return select((flags & INSTANCE_HAS_COLORS) != 0u, color, vec4(1.0f));
}

inline Float doubled_area(vec2 a, vec2 b, vec2 c) { return abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)); }

// `corners` and `flags` are those of fetch_corners and of the instance.
inline Attributes fetch_attributes(uvec4 corners, Uint flags, Float u, Float v) {
    Float w = (1.0f - u) - v;
    Rows rows0 = rows_from(corners.x);
    Rows rows1 = rows_from(corners.y);
    Rows rows2 = rows_from(corners.z);
    vec4 normal0 = fetch_vertices(rows0, VERTEX_NORMAL);
    vec4 normal1 = fetch_vertices(rows1, VERTEX_NORMAL);
    vec4 normal2 = fetch_vertices(rows2, VERTEX_NORMAL);
    // Where there are none, of something else.
    vec4 uv_a = fetch_vertices(rows0, VERTEX_UV);
    vec4 uv_b = fetch_vertices(rows1, VERTEX_UV);
    vec4 uv_c = fetch_vertices(rows2, VERTEX_UV);
    Mask has_uv = (flags & INSTANCE_HAS_UV) != 0u;
    vec4 uv = select(has_uv, (uv_a * w + uv_b * u) + uv_c * v, vec4(0.0f));
    Attributes attributes;
    attributes.normal = (vec3(normal0) * w + vec3(normal1) * u) + vec3(normal2) * v;
    attributes.tangents =
        uvec4(floatBitsToUint(normal0.w), floatBitsToUint(normal1.w), floatBitsToUint(normal2.w), Uint(0u));
    attributes.color = vec4(1.0f);
    if (has_feature(FEATURE_VERTEX_COLORS)) {
        attributes.color = (vertex_color(corners.x, flags) * w + vertex_color(corners.y, flags) * u) +
                           vertex_color(corners.z, flags) * v;
    }
    attributes.uv0 = vec2(uv.x, uv.y);
    attributes.uv1 = vec2(uv.z, uv.w);
    Float area0 = doubled_area(vec2(uv_a.x, uv_a.y), vec2(uv_b.x, uv_b.y), vec2(uv_c.x, uv_c.y));
    Float area1 = doubled_area(vec2(uv_a.z, uv_a.w), vec2(uv_b.z, uv_b.w), vec2(uv_c.z, uv_c.w));
    attributes.uv_area0 = select(has_uv, area0, Float(0.0f));
    attributes.uv_area1 = select(has_uv, area1, Float(0.0f));
    if (has_feature(FEATURE_MORE_UV)) {
        vec4 more_a = fetch_vertices(rows0, VERTEX_MORE_UV);
        vec4 more_b = fetch_vertices(rows1, VERTEX_MORE_UV);
        vec4 more_c = fetch_vertices(rows2, VERTEX_MORE_UV);
        Mask has_more = (flags & INSTANCE_HAS_MORE_UV) != 0u;
        vec4 more = select(has_more, (more_a * w + more_b * u) + more_c * v, vec4(0.0f));
        attributes.uv2 = vec2(more.x, more.y);
        attributes.uv3 = vec2(more.z, more.w);
        Float area2 = doubled_area(vec2(more_a.x, more_a.y), vec2(more_b.x, more_b.y), vec2(more_c.x, more_c.y));
        Float area3 = doubled_area(vec2(more_a.z, more_a.w), vec2(more_b.z, more_b.w), vec2(more_c.z, more_c.w));
        attributes.uv_area2 = select(has_more, area2, Float(0.0f));
        attributes.uv_area3 = select(has_more, area3, Float(0.0f));
    }
    return attributes;
}

// First rows of the vertices of a mesh triangle, and its material in w.
inline uvec4 fetch_corners(vec4 mesh_row, Uint primitive) {
    uvec4 corners = fetch_mesh_triangles(floatBitsToUint(mesh_row.x) + primitive);
    Uint first = floatBitsToUint(mesh_row.y);
    Uint rows = vertex_rows(floatBitsToUint(mesh_row.z));
    return uvec4(corners.x * rows + first, corners.y * rows + first, corners.z * rows + first, corners.w);
}

// A point on a surface as the ray that found it sees it.
struct Surface {
    vec3 position;
    vec3 geometric_normal;  // unit, on the front side
    vec3 normal;            // unit shading normal, on the front side
    vec4 color;
    TextureCoordinates coordinates;
    uvec4 tangents;  // of each vertex, in x, y and z
    Uint instance;
    Uint primitive;  // its triangle's number in the mesh
    Uint material;
    Float u;
    Float v;
    Float distance_squared;
    Float cone_width;
    Mask front;  // the ray comes from the front side
};

inline Surface make_surface(PathRay path_ray, Uint instance, TriangleVertices triangle) {
    Rows rows = rows_from(instance * INSTANCE_ROWS);
    vec4 row0 = fetch_instances(rows, INSTANCE_TRANSFORM);
    vec4 row1 = fetch_instances(rows, INSTANCE_TRANSFORM + 1u);
    vec4 row2 = fetch_instances(rows, INSTANCE_TRANSFORM + 2u);
    vec4 mesh_row = fetch_instances(rows, INSTANCE_MESH);
    Surface surface;
    uvec4 corners = fetch_corners(mesh_row, triangle.primitive);
    vec3 edge1 = triangle.v1 - triangle.v0;
    vec3 edge2 = triangle.v2 - triangle.v0;
    vec3 area = cross(edge1, edge2) * mesh_row.w;
    TriangleTest crossing =
        intersect_triangle(path_ray.ray.origin, path_ray.ray.direction, triangle.v0, triangle.v1, triangle.v2);
    surface.u = crossing.u;
    surface.v = crossing.v;
    Attributes attributes = fetch_attributes(corners, floatBitsToUint(mesh_row.z), surface.u, surface.v);
    surface.position = (triangle.v0 + edge1 * surface.u) + edge2 * surface.v;
    Float doubled = sqrt(max(dot(area, area), SMALLEST));
    surface.geometric_normal = area * (1.0f / doubled);
    surface.normal = normalized(transform_normal(row0, row1, row2, attributes.normal) * mesh_row.w);
    surface.color = attributes.color;
    surface.instance = instance;
    surface.primitive = triangle.primitive;
    surface.tangents = attributes.tangents;
    surface.material = corners.w;
    vec3 way = surface.position - path_ray.ray.origin;
    surface.distance_squared = dot(way, way);
    surface.cone_width = path_ray.cone_width + path_ray.cone_spread * sqrt(surface.distance_squared);
    Float cosine = dot(surface.geometric_normal, path_ray.ray.direction);
    surface.front = cosine < 0.0f;
    Float cover = square(surface.cone_width) / max(square(cosine) * doubled, SMALLEST);
    cover = min(cover, 1.0e20f);  // times no area at all, infinity would be no number
    surface.coordinates.uv0 = attributes.uv0;
    surface.coordinates.uv1 = attributes.uv1;
    surface.coordinates.footprint0 = attributes.uv_area0 * cover;
    surface.coordinates.footprint1 = attributes.uv_area1 * cover;
    if (has_feature(FEATURE_MORE_UV)) {
        surface.coordinates.uv2 = attributes.uv2;
        surface.coordinates.uv3 = attributes.uv3;
        surface.coordinates.footprint2 = attributes.uv_area2 * cover;
        surface.coordinates.footprint3 = attributes.uv_area3 * cover;
    }
    return surface;
}

// The octahedral direction, and the bitangent's sign in w.
inline vec4 unpack_tangent(Uint bits) {
    Float x = Float(bits & TANGENT_X_MASK) * 3.05180438e-5f - 1.0f;
    Float y = Float((bits >> TANGENT_Y_SHIFT) & TANGENT_Y_MASK) * 6.10370190e-5f - 1.0f;
    Float z = (1.0f - abs(x)) - abs(y);
    Float fold = max(-z, 0.0f);
    vec3 direction = vec3(x + select(x >= 0.0f, -fold, fold), y + select(y >= 0.0f, -fold, fold), z);
    return vec4(normalized(direction), select((bits >> TANGENT_SIGN_SHIFT) != 0u, Float(-1.0f), Float(1.0f)));
}

// The interpolated tangent and the bitangent at a point of an instance that has tangents.
inline Frame tangent_frame(Surface surface, Rows rows, vec4 mesh_row) {
    vec4 row0 = fetch_instances(rows, INSTANCE_TRANSFORM);
    vec4 row1 = fetch_instances(rows, INSTANCE_TRANSFORM + 1u);
    vec4 row2 = fetch_instances(rows, INSTANCE_TRANSFORM + 2u);
    vec4 tangent0 = unpack_tangent(surface.tangents.x);
    vec4 tangent1 = unpack_tangent(surface.tangents.y);
    vec4 tangent2 = unpack_tangent(surface.tangents.z);
    Float w = (1.0f - surface.u) - surface.v;
    vec3 interpolated = (vec3(tangent0) * w + vec3(tangent1) * surface.u) + vec3(tangent2) * surface.v;
    vec3 along = transform_vector(row0, row1, row2, interpolated);
    Frame frame;
    frame.tangent = normalized(along - surface.normal * dot(surface.normal, along));
    frame.bitangent = cross(surface.normal, frame.tangent) * (tangent0.w * mesh_row.w);
    frame.normal = surface.normal;
    return frame;
}

inline Mask has_tangents(vec4 mesh_row) { return (floatBitsToUint(mesh_row.z) & INSTANCE_HAS_TANGENTS) != 0u; }

// The shading normal bent by a normal map, which lies in the frame of the interpolated tangent.
inline vec3 bend_normal(Surface surface, Uint slot, Float scale) {
    Rows rows = rows_from(surface.instance * INSTANCE_ROWS);
    vec4 mesh_row = fetch_instances(rows, INSTANCE_MESH);
    Frame frame = tangent_frame(surface, rows, mesh_row);
    vec4 texel = sample_slot(slot, surface.coordinates);
    vec3 bent =
        (frame.tangent * ((2.0f * texel.x - 1.0f) * scale) + frame.bitangent * ((2.0f * texel.y - 1.0f) * scale)) +
        surface.normal * (2.0f * texel.z - 1.0f);
    return select(slot != NONE && has_tangents(mesh_row), normalized(bent), surface.normal);
}

// Where a lobe is stretched to by so much along tangent and bitangent; the zero vector without tangents.
inline vec3 stretched_along(Surface surface, vec2 stretch) {
    Rows rows = rows_from(surface.instance * INSTANCE_ROWS);
    vec4 mesh_row = fetch_instances(rows, INSTANCE_MESH);
    Frame frame = tangent_frame(surface, rows, mesh_row);
    vec3 along = frame.tangent * stretch.x + frame.bitangent * stretch.y;
    return select(has_tangents(mesh_row), along, vec3(0.0f));
}

}  // namespace target_core::kernels

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/coincident.h.
#ifndef COINCIDENT_GLSL
#define COINCIDENT_GLSL

#include "trace.glsl"

// The row of a hit's entry in the hash table of `coincident`, by its key there, or of the empty one where it would
// stand.
Uint find_coincident(Hit hit, Uint key, Uint mask, Mask where) {
    Uint place = key & mask;
    uvec4 entry = fetch_coincident(place + 1u);
    Mask searching = where && entry.x != NONE && (entry.x != hit.instance || entry.y != hit.triangle);
    while (any_lane(searching)) {
        place = select(searching, (place + 1u) & mask, place);
        entry = fetch_coincident(place + 1u);
        searching = searching && entry.x != NONE && (entry.x != hit.instance || entry.y != hit.triangle);
    }
    return place + 1u;
}

// Whether a point on another triangle lies in the place of one through `corner`: nearer to its plane than half of what
// a ray that leaves the point is moved off it, which so does not meet that triangle again.
Mask lies_beside(vec3 point, vec3 corner, vec3 normal) {
    Float apart = abs(dot(normal, point - corner));
    Float moved = abs(dot(normal, offset_point(point, normal) - point));
    return apart + apart <= moved;
}

// Rows of `coincident` to look at.
struct Partners {
    Uint row;
    Uint end;
};

// In which of so many equal parts of [0, 1] it lies.
Uint part_of(Float x, Uint parts) { return min(Uint(Int(saturate(x) * Float(parts))), parts - 1u); }

// False where nothing shares the place of what was hit there; true may be wrong.
Mask may_share(Hit hit, Uint key, uvec4 head) {
    Uint word = fetch_coincident_word(head.z + (key & head.w));
    Uint tag = word >> COINCIDENT_TAG_SHIFT;
    Uint cell = part_of(hit.v, COINCIDENT_CELLS) * COINCIDENT_CELLS + part_of(hit.u, COINCIDENT_CELLS);
    return ((word >> cell) & 1u) != 0u && (tag == (key >> COINCIDENT_TAG_SHIFT) || tag == COINCIDENT_TAG_ANY);
}

// What shares its place with the triangle of `entry` where it was hit, `first_partner` on.
Partners partners_at(Hit hit, uvec4 entry, Uint first_partner, Mask where) {
    Uint bin = part_of(hit.v, entry.w) * entry.w + part_of(hit.u, entry.w);
    uvec4 row = fetch_coincident(select(where, entry.z + bin, Uint(0u)));
    Partners partners;
    partners.row = first_partner + row.x;
    partners.end = partners.row + select(where, row.y, Uint(0u));
    return partners;
}

// The first of the partners that the ray meets in the place of its hit; `hit` where it meets none.
Hit first_in_place(Ray ray, Hit hit, Partners partners, Uint first_partner, Uint path) {
    Uint row = partners.row;
    Mask looking = row < partners.end;
    // Lanes that have nothing to look for read the first partner of all.
    uvec4 first = fetch_coincident(first_partner);
    TriangleVertices triangle =
        fetch_triangle(select(looking, hit.instance, first.x), select(looking, hit.triangle, first.y));
    vec3 normal = normalized(cross(triangle.v1 - triangle.v0, triangle.v2 - triangle.v0));
    Uint key = ray_key(path, RAY_EXTENSION);
    while (any_lane(looking)) {
        uvec4 other = fetch_coincident(select(looking, row, first_partner));
        TriangleVertices its = fetch_triangle(other.x, other.y);
        TriangleTest test = intersect_triangle(ray.origin, ray.direction, its.v0, its.v1, its.v2);
        vec3 point = (its.v0 + (its.v1 - its.v0) * test.u) + (its.v2 - its.v0) * test.v;
        Mask taken = looking && test.hit && lies_beside(point, triangle.v0, normal);
        if (has_feature(FEATURE_ALPHA)) {
            taken = taken && meets_surface(uintBitsToFloat(other.w), key, other.x, other.z, test.u, test.v);
        }
        hit.instance = select(taken, other.x, hit.instance);
        hit.triangle = select(taken, other.y, hit.triangle);
        row = row + 1u;
        looking = looking && !taken && row < partners.end;
    }
    return hit;
}

// Where several triangles lie in one place, which of them a ray meets first is a matter of rounding, and of who walks
// which tree. So the one of the lowest (instance, primitive) counts, whichever was met.
Hit lowest_in_place(Ray ray, Hit hit, Uint path) {
    uvec4 head = fetch_coincident(Uint(0u));
    Uint key = hash_pair(hit.instance, hit.triangle);
    Mask shares = hit.instance != NONE && may_share(hit, key, head);
    if (any_lane(shares)) {
        uvec4 entry = fetch_coincident(find_coincident(hit, key, head.x, shares));
        Partners partners = partners_at(hit, entry, head.y, shares && entry.x != NONE);
        if (any_lane(partners.row < partners.end)) {
            hit = first_in_place(ray, hit, partners, head.y, path);
        }
    }
    return hit;
}

#endif

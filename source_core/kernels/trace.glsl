// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: rewritten; the port is target_core/kernels/trace.h. The contract of both: trace_closest finds the smallest
// t > 0, ties go to the lower (instance, primitive); trace_any tells whether something lies in 0 < t < tmax; triangles
// that let rays through are decided by meets_surface; fetch_triangle gives the world-space vertices of a hit. Hits are
// found by intersect_triangle on world-space vertices alone: the walk must visit every box that the ray may touch, and
// nothing may depend on its order.
#ifndef TRACE_GLSL
#define TRACE_GLSL

#include "alpha.glsl"
#include "intersect.glsl"

const uint DONE = LEAF | LEAF_FIRST_MASK;       // at the bottom of the stack: an empty leaf
const uint LEAVE_INSTANCE = LEAF | MOST_SLOTS;  // on the stack, an empty leaf too: the instance's tree is done
const float NO_HIT = 1.0e29f;                   // beyond every box but those of empty children
const float MISSED = 2.0e30f;                   // beyond every distance
const float PAD_SCALE = 4.76837158203125e-7f;   // 2^-21

uint trace_stack[STACK_SIZE];

// The host's vertices of a triangle slot, in mesh or in world space.
struct TriangleSlot {
    vec3 v0;
    vec3 v1;
    vec3 v2;
    Float opacity;
    Uint primitive;
    Uint instance;
};

TriangleSlot fetch_slot(Uint slot) {
    Uint row = slot * TRIANGLE_ROWS;
    vec4 row0 = fetch_triangles(row);
    vec4 row1 = fetch_triangles(row + 1u);
    vec4 row2 = fetch_triangles(row + 2u);
    TriangleSlot triangle;
    triangle.v0 = vec3(row0);
    triangle.v1 = vec3(row1);
    triangle.v2 = vec3(row2);
    triangle.opacity = row0.w;
    triangle.primitive = floatBitsToUint(row1.w);
    triangle.instance = floatBitsToUint(row2.w);
    return triangle;
}

// Brings mesh-space vertices to world space; baked ones are there already.
TriangleSlot place_slot(TriangleSlot triangle, Uint instance) {
    TriangleSlot placed = triangle;
    if (has_feature(FEATURE_INSTANCES)) {
        Mask moves = triangle.instance == NONE;
        Uint row = select(moves, instance, 0u) * INSTANCE_ROWS;
        vec4 row0 = fetch_instances(row);
        vec4 row1 = fetch_instances(row + 1u);
        vec4 row2 = fetch_instances(row + 2u);
        placed.v0 = select(moves, transform_point(row0, row1, row2, triangle.v0), triangle.v0);
        placed.v1 = select(moves, transform_point(row0, row1, row2, triangle.v1), triangle.v1);
        placed.v2 = select(moves, transform_point(row0, row1, row2, triangle.v2), triangle.v2);
        placed.instance = select(moves, instance, triangle.instance);
    }
    return placed;
}

TriangleVertices fetch_triangle(Uint instance, Uint triangle) {
    TriangleSlot slot = place_slot(fetch_slot(triangle), instance);
    TriangleVertices vertices;
    vertices.v0 = slot.v0;
    vertices.v1 = slot.v1;
    vertices.v2 = slot.v2;
    vertices.primitive = slot.primitive;
    return vertices;
}

// A ray as boxes see it. Boxes grow by a pad, or rather the origin moves towards them by it: `near` is the origin for
// the planes that the ray meets first, `far` for the others. Of each pair of rows in a node, the planes met first
// are those at `near_row`.
struct BoxRay {
    vec3 near;
    vec3 far;
    vec3 inverse;
    uvec3 near_row;
    uvec3 far_row;
};

Float safe_inverse(Float x) { return 1.0f / select(abs(x) < 1.0e-20f, select(x < 0.0f, -1.0e-20f, 1.0e-20f), x); }

BoxRay make_box_ray(vec3 origin, vec3 direction, vec3 pad) {
    Mask back_x = direction.x < 0.0f;
    Mask back_y = direction.y < 0.0f;
    Mask back_z = direction.z < 0.0f;
    uvec3 back = uvec3(select(back_x, 1u, 0u), select(back_y, 1u, 0u), select(back_z, 1u, 0u));
    vec3 shift = vec3(select(back_x, -pad.x, pad.x), select(back_y, -pad.y, pad.y), select(back_z, -pad.z, pad.z));
    BoxRay box_ray;
    box_ray.near = origin + shift;
    box_ray.far = origin - shift;
    box_ray.inverse = vec3(safe_inverse(direction.x), safe_inverse(direction.y), safe_inverse(direction.z));
    box_ray.near_row = uvec3(0u, 2u, 4u) + back;
    box_ray.far_row = uvec3(1u, 3u, 5u) - back;
    return box_ray;
}

BoxRay make_world_box_ray(Ray ray) {
    vec3 reach = abs(ray.origin) + vec3(settings.scene_extent);
    Float pad = max(max(reach.x, reach.y), reach.z) * PAD_SCALE;
    return make_box_ray(ray.origin, ray.direction, vec3(pad));
}

// The world-space ray in the mesh space of an instance: good for boxes only.
BoxRay make_mesh_box_ray(Ray ray, Uint row) {
    vec4 row0 = fetch_nodes(row);
    vec4 row1 = fetch_nodes(row + 1u);
    vec4 row2 = fetch_nodes(row + 2u);
    vec4 pad_row = fetch_nodes(row + RECORD_PAD);
    vec4 growth_row = fetch_nodes(row + RECORD_INSTANCE);
    vec3 reach = abs(ray.origin);
    vec3 pad = vec3(pad_row) + vec3(growth_row) * max(max(reach.x, reach.y), reach.z);
    return make_box_ray(transform_point(row0, row1, row2, ray.origin),
                        transform_vector(row0, row1, row2, ray.direction), pad);
}

// Where the ray enters the four children of a node; MISSED where it passes by or comes too late.
vec4 entry_distances(BoxRay box_ray, Uint row, Float latest) {
    vec4 near = (fetch_nodes(row + box_ray.near_row.x) - box_ray.near.x) * box_ray.inverse.x;
    vec4 far = (fetch_nodes(row + box_ray.far_row.x) - box_ray.far.x) * box_ray.inverse.x;
    near = max(near, (fetch_nodes(row + box_ray.near_row.y) - box_ray.near.y) * box_ray.inverse.y);
    far = min(far, (fetch_nodes(row + box_ray.far_row.y) - box_ray.far.y) * box_ray.inverse.y);
    near = max(near, (fetch_nodes(row + box_ray.near_row.z) - box_ray.near.z) * box_ray.inverse.z);
    far = min(far, (fetch_nodes(row + box_ray.far_row.z) - box_ray.far.z) * box_ray.inverse.z);
    near = max(near, 0.0f);
    far = min(far, latest);
    return vec4(select(near.x <= far.x, near.x, MISSED), select(near.y <= far.y, near.y, MISSED),
                select(near.z <= far.z, near.z, MISSED), select(near.w <= far.w, near.w, MISSED));
}

void push_word(inout Uint depth, Uint word, Mask where) {
    if (where) {
        trace_stack[depth] = word;
        depth += 1u;
    }
}

Uint pop_word(inout Uint depth) {
    depth -= 1u;
    return trace_stack[depth];
}

// Two children with their distances, the nearer one first.
void order(inout Float near_a, inout Uint word_a, inout Float near_b, inout Uint word_b) {
    Mask swaps = near_b < near_a;
    Float near = select(swaps, near_a, near_b);
    Uint word = select(swaps, word_a, word_b);
    near_a = select(swaps, near_b, near_a);
    word_a = select(swaps, word_b, word_a);
    near_b = near;
    word_b = word;
}

// From a node to the child to visit next; the others that the ray meets go on the stack, the farthest first.
Uint descend(BoxRay box_ray, Uint node, Float latest, inout Uint depth) {
    Uint row = node * NODE_ROWS;
    vec4 near = entry_distances(box_ray, row, latest);
    uvec4 words = floatBitsToUint(fetch_nodes(row + NODE_CHILDREN));
    order(near.x, words.x, near.y, words.y);
    order(near.z, words.z, near.w, words.w);
    order(near.x, words.x, near.z, words.z);
    order(near.y, words.y, near.w, words.w);
    order(near.y, words.y, near.z, words.z);
    push_word(depth, words.w, near.w < MISSED);
    push_word(depth, words.z, near.z < MISSED);
    push_word(depth, words.y, near.y < MISSED);
    return near.x < MISSED ? words.x : pop_word(depth);
}

// A triangle that the ray crosses.
struct Crossing {
    Uint instance;  // NONE: nothing
    Uint triangle;
    Uint primitive;
    Float t;
    Float u;
    Float v;
};

// Where a walk stands.
struct Walk {
    Uint word;      // what to visit next: a node, or what is left of a leaf
    Uint depth;     // entries on the stack
    Uint instance;  // whose tree this is; NONE: the scene's
    Crossing best;
    Mask undecided;  // `candidate` would be the best if rays do not pass through it
    Crossing candidate;
    Float candidate_opacity;
};

Walk start_walk(Float tmax) {
    Walk walk;
    walk.best.instance = NONE;
    walk.best.triangle = 0u;
    walk.best.primitive = 0u;
    walk.best.t = tmax;
    walk.best.u = 0.0f;
    walk.best.v = 0.0f;
    walk.undecided = false;
    walk.candidate = walk.best;
    walk.candidate_opacity = 1.0f;
    walk.instance = NONE;
    walk.word = 0u;
    walk.depth = 0u;
    push_word(walk.depth, DONE, true);
    return walk;
}

Crossing select(Mask where, Crossing yes, Crossing no) {
    Crossing crossing;
    crossing.instance = select(where, yes.instance, no.instance);
    crossing.triangle = select(where, yes.triangle, no.triangle);
    crossing.primitive = select(where, yes.primitive, no.primitive);
    crossing.t = select(where, yes.t, no.t);
    crossing.u = select(where, yes.u, no.u);
    crossing.v = select(where, yes.v, no.v);
    return crossing;
}

// Tests the first triangle of the leaf in walk.word, and takes it off.
void test_next(Ray ray, bool any_hit, inout Walk walk) {
    Uint slot = walk.word & LEAF_FIRST_MASK;
    walk.word += 1u - (1u << LEAF_COUNT_SHIFT);
    TriangleSlot triangle = place_slot(fetch_slot(slot), walk.instance);
    TriangleTest test = intersect_triangle(ray.origin, ray.direction, triangle.v0, triangle.v1, triangle.v2);
    Mask earlier = triangle.instance < walk.best.instance ||
                   (triangle.instance == walk.best.instance && triangle.primitive < walk.best.primitive);
    Mask better = test.hit && (test.t < walk.best.t || (!any_hit && test.t == walk.best.t && earlier));
    Crossing crossing;
    crossing.instance = triangle.instance;
    crossing.triangle = slot;
    crossing.primitive = triangle.primitive;
    crossing.t = test.t;
    crossing.u = test.u;
    crossing.v = test.v;
    if (has_feature(FEATURE_ALPHA)) {
        walk.undecided = better && triangle.opacity < 1.0f;
        walk.candidate = crossing;
        walk.candidate_opacity = triangle.opacity;
        better = better && !walk.undecided;
    }
    walk.best = select(better, crossing, walk.best);
}

void decide_candidate(Uint key, inout Walk walk) {
    Mask met = walk.undecided && meets_surface(walk.candidate_opacity, key, walk.candidate.instance,
                                               walk.candidate.primitive, walk.candidate.u, walk.candidate.v);
    walk.best = select(met, walk.candidate, walk.best);
    walk.undecided = false;
}

// Goes over to the tree of an instance, or back to the scene's.
void change_tree(Ray ray, inout BoxRay box_ray, inout Walk walk) {
    Uint count = (walk.word >> LEAF_COUNT_SHIFT) & LEAF_COUNT_MASK;
    if (walk.word == LEAVE_INSTANCE) {
        box_ray = make_world_box_ray(ray);
        walk.instance = NONE;
    } else if (count == LEAF_INSTANCE) {
        Uint row = (walk.word & LEAF_FIRST_MASK) * NODE_ROWS;
        box_ray = make_mesh_box_ray(ray, row);
        walk.instance = floatBitsToUint(fetch_nodes(row + RECORD_INSTANCE).w);
        push_word(walk.depth, LEAVE_INSTANCE, true);
        push_word(walk.depth, floatBitsToUint(fetch_nodes(row + RECORD_PAD).w), true);
        walk.word = LEAF;
    }
}

Mask has_triangles(Uint word) { return ((word >> LEAF_COUNT_SHIFT) & LEAF_COUNT_MASK) != 0u; }

// The walk of both kinds of rays, up to its end or to a triangle that has to be decided. Loops test at their end and
// costly decisions stand outside of them: lavapipe runs a loop's body once before it looks whether any lane needs it,
// and both sides of every branch.
void walk_on(Ray ray, bool any_hit, inout BoxRay box_ray, inout Walk walk) {
    do {
        do {
            if ((walk.word & LEAF) == 0u) {
                walk.word = descend(box_ray, walk.word, walk.best.t, walk.depth);
            }
        } while ((walk.word & LEAF) == 0u);
        if (has_feature(FEATURE_INSTANCES)) {
            change_tree(ray, box_ray, walk);
        }
        do {
            if (has_triangles(walk.word)) {
                test_next(ray, any_hit, walk);
            }
        } while (has_triangles(walk.word) && !walk.undecided);
        if (any_hit && walk.best.instance != NONE) {
            walk.word = DONE;
        }
        if (walk.word != DONE && !walk.undecided) {
            walk.word = pop_word(walk.depth);
        }
    } while (walk.word != DONE && !walk.undecided);
}

Crossing walk_tree(Ray ray, Float tmax, Uint key, bool any_hit) {
    BoxRay box_ray = make_world_box_ray(ray);
    Walk walk = start_walk(tmax);
    do {
        walk_on(ray, any_hit, box_ray, walk);
        if (has_feature(FEATURE_ALPHA)) {
            decide_candidate(key, walk);
            if (any_hit && walk.best.instance != NONE) {
                walk.word = DONE;
            }
        }
    } while (walk.word != DONE);
    return walk.best;
}

Hit trace_closest(Ray ray, Uint path) {
    Crossing crossing = walk_tree(ray, NO_HIT, ray_key(path, RAY_EXTENSION), false);
    Hit hit;
    hit.instance = crossing.instance;
    hit.triangle = crossing.triangle;
    hit.u = crossing.u;
    hit.v = crossing.v;
    return hit;
}

Mask trace_any(Ray ray, Float tmax, Uint path) {
    return walk_tree(ray, min(tmax, NO_HIT), ray_key(path, RAY_SHADOW), true).instance != NONE;
}

#endif

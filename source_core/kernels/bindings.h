// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: one-sided: where the buffers are bound, and the tables that only this core has. Valid as GLSL and as C++.
#ifndef SOURCE_CORE_BINDINGS_H
#define SOURCE_CORE_BINDINGS_H

#include "layout.h"

#ifdef __cplusplus
namespace source_core {
#endif

// ---- Bindings of set 0. Scene tables first; a table's binding is also its slot in the block of addresses. ----

const uint BINDING_NODES = 0u;
const uint BINDING_TRIANGLES = 1u;
const uint BINDING_MESH_TRIANGLES = 2u;
const uint BINDING_VERTICES = 3u;
const uint BINDING_INSTANCES = 4u;
const uint BINDING_MATERIALS = 5u;
const uint BINDING_TEXTURE_SLOTS = 6u;
const uint BINDING_TEXTURES = 7u;
const uint BINDING_TEXELS = 8u;
const uint BINDING_LIGHTS = 9u;
const uint BINDING_LIGHT_TABLE = 10u;
const uint BINDING_SKY_TEXELS = 11u;
const uint BINDING_SKY_TABLE = 12u;
const uint BINDING_LOBE_ENERGY = 13u;
const uint BINDING_COINCIDENT = 14u;
const uint TABLE_COUNT = 15u;
const uint BINDING_SETTINGS = 15u;
const uint BINDING_ADDRESSES = 16u;
const uint BINDING_PATH_ORIGIN = 17u;
const uint BINDING_PATH_DIRECTION = 18u;
const uint BINDING_PATH_THROUGHPUT = 19u;
const uint BINDING_PATH_RADIANCE = 20u;
const uint BINDING_SURFACE_QUEUE = 21u;  // what rays of this segment met
const uint BINDING_QUEUE = 22u;          // of this segment
const uint BINDING_NEXT_QUEUE = 23u;     // of the next segment
const uint BINDING_SHADOW_ORIGIN = 24u;
const uint BINDING_SHADOW_DIRECTION = 25u;
const uint BINDING_SHADOW_CONTRIBUTION = 26u;
const uint BINDING_COUNTERS = 27u;
const uint BINDING_ARGUMENTS = 28u;
const uint BINDING_ACCUMULATOR = 29u;
const uint BINDING_TARGET = 30u;
const uint BINDING_COUNT = 31u;

// A filter's buffers, in the place of what its kernels leave alone: devices bind few.
const uint BINDING_GUIDES = BINDING_ACCUMULATOR;
const uint BINDING_FILTER_PICTURE = BINDING_TARGET;
const uint BINDING_PLANES = BINDING_SHADOW_CONTRIBUTION;
const uint BINDING_HISTORY = BINDING_SHADOW_ORIGIN;
const uint BINDING_HISTORY_BEFORE = BINDING_SHADOW_DIRECTION;

// counters: the rays of all passes since the buffer was cleared, then three words per segment, from segment 0.
const uint COUNTER_EXTENSION_TOTAL = 0u;
const uint COUNTER_SHADOW_TOTAL = 1u;
const uint COUNTER_SEGMENTS = 2u;
const uint COUNTERS_PER_SEGMENT = 3u;
const uint COUNTER_EXTENSION = 0u;  // entries in the segment's queue
const uint COUNTER_SHADOW = 1u;     // shadow rays that shading the segment pushed
const uint COUNTER_SURFACE = 2u;    // rays of the segment that met a surface

// arguments: work groups in x, y and z of the next extend and shade (whose jobs are no more), then of the next connect.
const uint ARGUMENTS_EXTENSION = 0u;
const uint ARGUMENTS_SHADOW = 4u;
const uint ARGUMENTS_WORDS = 8u;

// ---- nodes: 7 rows per node; node 0 is the root of the scene. ----

// A 4-wide node: lower x of the four children, upper x, lower y, upper y, lower z, upper z, child words as bits.
const uint NODE_ROWS = 7u;
const uint NODE_CHILDREN = 6u;

// A child word is the number of a node, or a leaf: LEAF, a count of triangles in bits 28 to 30, the first triangle
// slot below. A leaf of no triangles is empty; one of LEAF_INSTANCE triangles is an instance, its record below. The
// two largest slots are never used: as empty leaves they mark places on the stack.
const uint LEAF = 0x80000000u;
const uint LEAF_COUNT_SHIFT = 28u;
const uint LEAF_COUNT_MASK = 7u;
const uint LEAF_INSTANCE = 7u;
const uint LEAF_FIRST_MASK = 0x0fffffffu;
const uint MOST_SLOTS = 0x0ffffffeu;

// An instance's record takes a node's place: 3 rows of the world-to-mesh matrix; a row with what rays are padded by
// in mesh space at least, and the root of the mesh's tree; a row with the instance's number, and what the pad grows
// by per unit of the world-space origin.
const uint RECORD_PAD = 3u;
const uint RECORD_INSTANCE = 4u;

// ---- triangles: 3 rows per slot. A slot is trace's handle of a triangle. ----
// vertex 0, opacity (1 opaque, [0, 1) constant coverage, negative: needs the texture or the vertex colours)
// vertex 1, the triangle's number in its mesh as bits
// vertex 2, instance as bits: the vertices are in world space; NONE: in mesh space
const uint TRIANGLE_ROWS = 3u;

const uint STACK_SIZE = 64u;  // entries a ray; the host builds no tree that needs more

#ifdef __cplusplus
}  // namespace source_core
#endif

#endif  // SOURCE_CORE_BINDINGS_H

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/layout.h. Valid as GLSL and as C++: the kernels and the host read the same text.
#ifndef TARGET_CORE_LAYOUT_H
#define TARGET_CORE_LAYOUT_H

#ifdef __cplusplus
#include "target_core/device/glsl.h"
namespace target_core {
#endif

// ---- Scene tables: read through the fetch functions of buffers. A row is one vec4 or uvec4. ----

// nodes and triangles belong to trace, the only kernel text that knows the acceleration structure.

// mesh_triangles: uvec4 per triangle (vertex, vertex, vertex, material); vertices count from the mesh's first.

// vertices: a row per vertex, one more where its mesh has texture coordinates, one more where it has more than two sets
// of them and one more where it has colours; at the end rows that no vertex has.
const uint VERTEX_NORMAL = 0u;   // normal.xyz, tangent as bits
const uint VERTEX_UV = 1u;       // uv0.xy, uv1.xy
const uint VERTEX_MORE_UV = 2u;  // uv2.xy, uv3.xy
const uint VERTEX_COLOR = 0u;    // from the last row on: linear rgba

// rgba8, a texel in one word: red in the lowest byte.
const uint RGBA8_MASK = 255u;
const uint RGBA8_GREEN_SHIFT = 8u;
const uint RGBA8_BLUE_SHIFT = 16u;
const uint RGBA8_ALPHA_SHIFT = 24u;

// A tangent in one word: octahedral, x in the lowest 16 bits, y in 15, then the bitangent's sign.
const uint TANGENT_X_MASK = 65535u;
const uint TANGENT_Y_SHIFT = 16u;
const uint TANGENT_Y_MASK = 32767u;
const uint TANGENT_SIGN_SHIFT = 31u;  // 1: the bitangent is turned round

// instances: 4 rows per instance.
const uint INSTANCE_ROWS = 4u;
const uint INSTANCE_TRANSFORM = 0u;  // 3 rows of the object-to-world matrix
const uint INSTANCE_MESH = 3u;       // first mesh triangle, first row of vertices, flags (as bits), determinant's sign
const uint INSTANCE_HAS_TANGENTS = 1u;
const uint INSTANCE_HAS_UV = 2u;
const uint INSTANCE_HAS_COLORS = 4u;
const uint INSTANCE_HAS_MORE_UV = 8u;  // never without INSTANCE_HAS_UV
const uint INSTANCE_UV_SHIFT = 1u;
const uint INSTANCE_COLORS_SHIFT = 2u;
const uint INSTANCE_MORE_UV_SHIFT = 3u;

// materials: 14 rows per material. The slots are in the order of the render system's kTextureSlots.
const uint MATERIAL_ROWS = 14u;
const uint MATERIAL_BASE_COLOR = 0u;   // base_color.rgb, alpha
const uint MATERIAL_SURFACE = 1u;      // metallic, roughness, specular, transmission
const uint MATERIAL_EMISSION = 2u;     // emission.rgb, emission_weight
const uint MATERIAL_SPECULAR = 3u;     // specular_color.rgb, ior
const uint MATERIAL_ALPHA = 4u;        // normal_scale, alpha_cutoff, flags as bits, row in lobe_energy as bits
const uint MATERIAL_SLOTS = 5u;        // slots as bits: base_color, metallic_roughness, normal, emission
const uint MATERIAL_MORE_SLOTS = 6u;   // slots as bits: transmission, specular, specular_color, sheen_color
const uint MATERIAL_SHEEN = 7u;        // sheen_color.rgb, sheen_roughness
const uint MATERIAL_LOBES = 8u;        // sheen's row in lobe_energy as bits, coat, coat_roughness, coat_normal_scale
const uint MATERIAL_LOBE_SLOTS = 9u;   // slots as bits: sheen_roughness, coat, coat_roughness, coat_normal
const uint MATERIAL_FILM = 10u;        // film, film_ior, least and greatest thickness in nanometres
const uint MATERIAL_FILM_SLOTS = 11u;  // slots as bits: film, film_thickness, anisotropy, unused
const uint MATERIAL_VOLUME = 12u;      // absorption.rgb, unused
const uint MATERIAL_ANISOTROPY = 13u;  // strength, its row in lobe_energy as bits, cosine and sine of its rotation
const uint MATERIAL_OPAQUE = 1u;
const uint MATERIAL_DOUBLE_SIDED = 2u;
const uint MATERIAL_THIN_WALLED = 4u;

// lobe_energy: what one scattering returns of the light, by the root of the cosine (columns) and the roughness (lines).
// A row is a cell: values at its corners, both of the lower roughness first. A value is two of 16 bits: of all light,
// and above it of what is reflected, times Schlick's weight. Slice 0 is of reflection alone; a material that refracts
// has one for light from the front and one from behind; after these, if it is stretched, all slices of its lobe from
// the front, then from behind. Sheen has its own: what it returns, and above it what it is scaled by to return no more
// than there is.
const uint ENERGY_CELLS = 23u;  // columns, and lines
const uint ENERGY_ROWS = 529u;  // of a slice
// A stretched lobe has a slice for each of so many steps of strength and, fastest, of wo's turn, and one more
// at the end of each.
const uint ENERGY_STRENGTHS = 12u;
const uint ENERGY_TURNS = 5u;
const uint STRETCHED_ROWS = 78u * ENERGY_ROWS;  // of all of them
const uint ENERGY_MASK = 65535u;
const uint ENERGY_SHIFT = 16u;

// texture_slots: 2 rows per slot.
const uint SLOT_ROWS = 2u;
const uint SLOT_U = 0u;  // row_u.xyz, texture as bits
const uint SLOT_V = 1u;  // row_v.xyz, uv set as bits

// textures: uvec4 rows: row i is the header of texture i: format (in the lowest bits), wraps and nearest in one word;
// texels of level 0 as the bits of a float; levels; row of level 0. The rows of levels follow all headers: first word
// of texels, width, height, unused.
const uint TEXTURE_FIELD_MASK = 255u;  // of format and wraps
const uint TEXTURE_WRAP_S_SHIFT = 8u;
const uint TEXTURE_WRAP_T_SHIFT = 16u;
const uint TEXTURE_NEAREST_SHIFT = 24u;
const uint TEXEL_RGBA8 = 0u;
const uint TEXEL_RGBA8_SRGB = 1u;
const uint TEXEL_RGB9E5 = 2u;  // red in the lowest bits
const uint TEXEL_RGBA16 = 3u;  // from here on two words: red in the low half of the first, blue in that of the second
const uint TEXEL_RGBA16_SRGB = 4u;
const uint RGBA16_MASK = 65535u;
const uint RGBA16_SHIFT = 16u;
const uint RGB9E5_MASK = 511u;
const uint RGB9E5_GREEN_SHIFT = 9u;
const uint RGB9E5_BLUE_SHIFT = 18u;
const uint RGB9E5_EXPONENT_SHIFT = 27u;
const uint RGB9E5_FLOAT_EXPONENT = 103u;  // added to the exponent, makes it the one of a float: 127 - 15 - 9
const uint FLOAT_EXPONENT_SHIFT = 23u;
const uint WRAP_REPEAT = 0u;
const uint WRAP_MIRRORED_REPEAT = 1u;
const uint WRAP_CLAMP_TO_EDGE = 2u;

// lights: 6 rows per light.
const uint LIGHT_ROWS = 6u;
const uint LIGHT_POSITION = 0u;  // vertex 0 or position, kind as bits
const uint LIGHT_VERTEX1 = 1u;   // vertex 1 or direction, two_sided as bits
const uint LIGHT_VERTEX2 = 2u;   // vertex 2, twice the probability (triangle) | spot_scale, spot_offset, unused, unused
const uint LIGHT_EMISSION = 3u;  // emission.rgb, texture as bits
const uint LIGHT_UV01 = 4u;      // uv of vertices 0 and 1
const uint LIGHT_UV2 = 5u;       // uv of vertex 2, unused, unused
const uint LIGHT_TRIANGLE = 0u;
const uint LIGHT_POINT = 1u;
const uint LIGHT_SPOT = 2u;
const uint LIGHT_DIRECTIONAL = 3u;
const uint LIGHT_SKY = 4u;

// light_table, sky_table: one row per entry: threshold, alias as bits, probability, unused.
// sky_texels: one row per texel: radiance.rgb, probability of the texel in sky_table.

// coincident: what lies in one place, uvec4 rows. Row 0: mask of the hash table that follows, row of the first partner,
// first word of the filter, mask of its words.
// The hash table, by hash_pair of the first two: instance, trace's handle, row of the first bin, bins along a side of u
// and v; instance NONE: empty. The bins, u fastest: first partner, partners. The partners, in each bin the lowest
// (instance, primitive) first: instance, trace's handle, primitive, opacity as bits. The filter: one word for
// the entries of a place in it, small enough to stay near the processor: the upper half of their key, and a bit for
// each part of their u and v, of so many along a side, in which there is something.
const uint COINCIDENT_CELLS = 4u;
const uint COINCIDENT_TAG_SHIFT = 16u;
const uint COINCIDENT_TAG_ANY = 0xffffu;  // in place of that half where entries of several keys share the word

// ---- Features of the scene: kernels leave out what a scene does not need. ----

const uint FEATURE_INSTANCES = 1u;       // some meshes are not in world space
const uint FEATURE_ALPHA = 2u;           // some triangles let rays through
const uint FEATURE_ALPHA_TEXTURES = 4u;  // and need a texture or a vertex colour for that
const uint FEATURE_TEXTURES = 8u;        // some material reads a texture other than a normal map
const uint FEATURE_NORMAL_MAPS = 16u;
const uint FEATURE_LIGHTS = 32u;  // next event estimation has something to choose
const uint FEATURE_EMISSION_TEXTURES = 64u;
const uint FEATURE_SKY_MAP = 128u;
const uint FEATURE_TRANSMISSION = 256u;
const uint FEATURE_PUNCTUAL_LIGHTS = 512u;
const uint FEATURE_VERTEX_COLORS = 1024u;
const uint FEATURE_SPECULAR_TEXTURES = 2048u;  // transmission, specular or specular colour from a texture
const uint FEATURE_SHEEN = 4096u;
const uint FEATURE_LOBE_TEXTURES = 8192u;  // something of sheen, coat, film or anisotropy from a texture
const uint FEATURE_COAT = 16384u;
const uint FEATURE_FILM = 32768u;
const uint FEATURE_VOLUME = 65536u;       // some solid absorbs light
const uint FEATURE_COINCIDENT = 131072u;  // some triangles lie in one place
const uint FEATURE_ANISOTROPY = 262144u;
const uint FEATURE_DEEP_TEXELS = 524288u;  // some textures have 16 bits a channel
const uint FEATURE_MORE_UV = 1048576u;     // some material reads a third or fourth set of texture coordinates

const uint NONE = 0xFFFFFFFFu;

// ---- What a filter has beside the picture; only where one is asked for. ----

// guides: 6 rows per pixel, sums over its camera rays: two layers of surfaces, then what belongs to none. Two more
// where there is a history.
const uint GUIDE_ROWS = 6u;
const uint GUIDE_ALBEDO = 0u;  // of a layer: albedo.rgb, nearness
const uint GUIDE_NORMAL = 1u;  // of a layer: shading normal on the ray's side, rays that met it
const uint GUIDE_LAYER = 2u;   // rows of a layer: the surface met first, then all others
const uint GUIDE_DIRECT = 4u;  // radiance of the first segments of paths, square of its luminance
const uint GUIDE_RAYS = 5u;    // how many, 1 if one more is taken
const uint GUIDE_MOTION = 6u;  // of each layer: columns and rows to where it was in the frame before, nearness there
const uint GUIDE_MOTION_ROWS = 2u;

// How far paths of guides go: to what lights the first surface. From the next surface on go those alone that left the
// first one in a direction of so much density per solid angle: what is seen in it is as sharp as it is itself.
const uint GUIDE_SEGMENTS = 3u;
const float GUIDE_SHARP = 2.0f;

// motions: 4 rows per instance, only where some has moved; then, a row each, where the vertices of meshes were that
// have changed their shape since, in the space of the mesh.
const uint MOTION_ROWS = 4u;
const uint MOTION_SHAPE = 3u;  // row of its first vertex as bits: the matrix is the one that placed it then; 0: the
                               // matrix takes points back to where they were

// planes: one number a pixel each. Light is radiance by albedo: indirect light is what the guides' paths do not bring.
// The rest is of the layer that has most of the picture's samples.
const uint PLANE_LIGHT = 0u;        // three of light, its variance, what was too bright; by turns with
const uint PLANE_OTHER_LIGHT = 5u;  // the other five
const uint PLANE_DIRECT = 10u;      // four of direct light, with one of these in place of a variance
const float LAYER_AND_SKY = -1.0f;  // where some rays met nothing
const float TWO_LAYERS = -2.0f;     // where some met something else
const uint PLANE_VARIANCE = 14u;    // of the light, as neighbours agree on it
const uint PLANE_NORMAL = 15u;      // three
const uint PLANE_NEARNESS = 18u;
const uint PLANE_SLOPE = 19u;   // two: what nearness grows by from pixel to pixel, to the right and down
const uint PLANE_TRUST = 21u;   // 1 where all samples met that layer, 0 where half of them did
const uint PLANE_LAYER = 22u;   // 1 where it is the second one
const uint PLANE_ALBEDO = 23u;  // three: its albedo by its share of the camera rays
const uint PLANES = 26u;

// histories: one number a pixel each: what a frame leaves to the next one.
const uint HISTORY_LIGHT = 0u;   // three of light and one of its variance, over all frames in it
const uint HISTORY_MOMENT = 4u;  // two: mean luminance of the light of one frame, and mean square
const uint HISTORY_LENGTH = 6u;  // frames that are in it
const uint HISTORY_NORMAL = 7u;  // three
const uint HISTORY_NEARNESS = 10u;
const uint HISTORY_PICTURE = 11u;  // three: what was shown
const uint HISTORY_PLANES = 14u;

// filter_picture: mean, and in w the variance of its luminance: negative where that is not known, NO_MEAN where the
// mean is no number. Behind it, motions.
const float NO_MEAN = 1.0e30f;

const uint FILTER_CHOOSE = 0u;      // before each camera ray of a guide: whether it is taken
const uint FILTER_GATHER = 1u;      // after its path: adds what that brought
const uint FILTER_DIVIDE = 2u;      // after the picture's own samples: picture to light
const uint FILTER_PREPARE = 3u;     // guides to planes
const uint FILTER_STEADY = 4u;      // slopes, and variances that neighbours agree on
const uint FILTER_LEVEL = 5u;       // one level of it
const uint FILTER_FINISH = 6u;      // direct light, and all light to the picture
const uint REPROJECT_LIGHT = 7u;    // light of the frame before to that of this one, before the levels
const uint REPROJECT_PICTURE = 8u;  // what was shown before to what is shown, after them

const uint STANDS_STILL = 0u;  // view and scene are those of the frame before
const uint VIEW_MOVES = 1u;    // or something else than an instance, which has no motion to follow
const uint INSTANCES_MOVE = 2u;
const uint VERTICES_MOVE = 3u;  // and they, of some meshes

// ---- Settings: the same for all kernels of one Render. Scalars come in fours: std140 and C++ agree. ----

struct Settings {
    vec4 eye;           // xyz; w: the angle of one pixel, for ray cones
    vec4 screen;        // top left corner of the screen minus the eye
    vec4 screen_right;  // top right minus top left
    vec4 screen_down;   // bottom left minus top left
    vec4 sky_radiance;  // rgb of a constant sky
    vec4 scene_extent;  // largest coordinate in magnitude: x, y, z; w: of a guide's paths GUIDE_SHARP, else 0
    vec4 lens_right;    // along screen_right, as long as the lens's radius; w: the radius, 0 for a pinhole
    vec4 lens_down;     // along screen_down, as long; w: the height of one pixel where rays are parallel, else 0
    uint width;
    uint height;
    uint seed;
    uint max_path_length;
    uint russian_roulette;
    uint next_event_estimation;
    uint light_count;
    uint features;
    uint sky_width;
    uint sky_height;
    float sky_light_probability;  // of the sky's entry in light_table
    float light_weight_scale;     // 1 / total weight: density per area = emission_weight * light_weight_scale
    float indirect_limit;         // of what one path of 3 segments or more brings; 0: none
    uint pixel_count;
    uint frame;
    uint motion;
    vec4 eye_before;
    vec4 screen_before;
    vec4 screen_right_before;
    vec4 screen_down_before;
};

// What changes from dispatch to dispatch.
struct Pass {
    uint sample_index;   // of this pass, for the random numbers
    uint segment;        // path segment that is traced or shaded now; 1 leaves the eye
    uint first_pixel;    // pixel of path 0
    uint path_count;     // paths in this batch
    float sample_scale;  // finalize: 1 / samples taken so far
    uint first_in_sum;   // finalize: 1 starts the sum, 0 adds to it
    uint filter_stage;
    uint filter_step;
    uint filter_from;
    uint filter_to;
};

#ifdef __cplusplus
}  // namespace target_core
#endif

#endif  // TARGET_CORE_LAYOUT_H

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/core_tables.h.
#pragma once

#include <span>
#include <vector>

#include "render_system/core_data.h"
#include "render_system/lobe_energy.h"
#include "target_core/kernels/layout.h"

namespace target_core {

/// Materials, textures, lights and sky as the rows that layout.h describes.
struct SceneTables {
    std::vector<vec4> materials;
    std::vector<vec4> texture_slots;
    std::vector<uvec4> textures;
    std::vector<uint> texels;
    uint texture_features = 0;  // what reading them needs
    std::vector<vec4> lights;
    std::vector<vec4> light_table;
    std::vector<vec4> sky_texels;
    std::vector<vec4> sky_table;
    std::vector<vec4> lobe_energy;
    render_system::LobeEnergy energies;  // where the rows of lobe_energy come from
};

/// Fills materials, texture_slots and lobe_energy.
void pack_materials(std::span<const render_system::CoreMaterial> materials, SceneTables& tables);

/// Fills textures, texels and texture_features.
void pack_textures(std::span<const render_system::CoreTexture> textures, SceneTables& tables);

/// Fills lights and light_table.
void pack_lights(const render_system::CoreLights& lights, SceneTables& tables);

/// Fills sky_texels and sky_table.
void pack_sky(const render_system::CoreSky& sky, SceneTables& tables);

/// At the end of the table of vertices: a kernel may read as many rows behind the last vertex's first.
constexpr size_t kSpareVertexRows = 2;

/// What of INSTANCE_HAS_... a mesh has.
uint vertex_flags(const render_system::CoreMesh& mesh);

/// How many attribute rows a mesh has: as many a vertex as its flags say.
size_t vertex_row_count(const render_system::CoreMesh& mesh);

/// Writes them, where there is room for all.
void pack_vertices(const render_system::CoreMesh& mesh, vec4* rows);

/// INSTANCE_ROWS rows of one instance.
void pack_instance(const render_system::CoreTransform& transform, uint first_triangle, uint first_vertex_row,
                   uint flags, vec4* rows);

/// What meets_surface takes for a triangle of this material: 1 opaque, [0, 1) constant coverage, -1 where texture
/// or vertex colours decide.
float opacity_code(const render_system::CoreMaterial& material, bool mesh_has_colors);

/// Feature bits that follow from materials and lights.
uint material_features(std::span<const render_system::CoreMaterial> materials);
uint light_features(const render_system::CoreLights& lights);

}  // namespace target_core

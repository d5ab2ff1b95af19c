// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/core_tables.cpp.
#include "target_core/core_tables.h"

#include <bit>
#include <cmath>
#include <iterator>

#include "render_system/give_back.h"

namespace target_core {

using namespace render_system;

namespace {

float as_float(uint bits) { return std::bit_cast<float>(bits); }

vec4 row(glm::vec3 v, float w) { return vec4(v.x, v.y, v.z, w); }

uint pack_slot(const CoreTextureSlot& slot, std::vector<vec4>& slots) {
    if (slot.texture == render_system::NONE) {
        return render_system::NONE;
    }
    uint index = static_cast<uint>(slots.size() / SLOT_ROWS);
    slots.push_back(row(slot.row_u, as_float(slot.texture)));
    slots.push_back(row(slot.row_v, as_float(slot.uv_set)));
    return index;
}

vec4 pack_alias(const AliasEntry& entry) {
    return vec4(entry.threshold, as_float(entry.alias), entry.probability, 0.0f);
}

// What kernels need for a texture in each of kTextureSlots.
constexpr uint kSlotFeatures[] = {
    FEATURE_TEXTURES,                              // base_color
    FEATURE_TEXTURES,                              // metallic_roughness
    FEATURE_NORMAL_MAPS,                           // normal
    FEATURE_TEXTURES | FEATURE_EMISSION_TEXTURES,  // emission
    FEATURE_TEXTURES | FEATURE_SPECULAR_TEXTURES,  // transmission
    FEATURE_TEXTURES | FEATURE_SPECULAR_TEXTURES,  // specular
    FEATURE_TEXTURES | FEATURE_SPECULAR_TEXTURES,  // specular_color
    FEATURE_TEXTURES | FEATURE_LOBE_TEXTURES,      // sheen_color
    FEATURE_TEXTURES | FEATURE_LOBE_TEXTURES,      // sheen_roughness
    FEATURE_TEXTURES | FEATURE_LOBE_TEXTURES,      // coat
    FEATURE_TEXTURES | FEATURE_LOBE_TEXTURES,      // coat_roughness
    FEATURE_TEXTURES | FEATURE_LOBE_TEXTURES,      // coat_normal
    FEATURE_TEXTURES | FEATURE_LOBE_TEXTURES,      // film
    FEATURE_TEXTURES | FEATURE_LOBE_TEXTURES,      // film_thickness
    FEATURE_TEXTURES | FEATURE_LOBE_TEXTURES,      // anisotropy
};
static_assert(ENERGY_CELLS == kEnergyCells);
static_assert(ENERGY_STRENGTHS == kEnergyStrengths && ENERGY_TURNS == kEnergyTurns);
static_assert(STRETCHED_ROWS == (ENERGY_STRENGTHS + 1u) * (ENERGY_TURNS + 1u) * ENERGY_ROWS);
static_assert(std::size(kSlotFeatures) == std::size(kTextureSlots));

bool has_sheen(const CoreMaterial& material) { return material.sheen_color != glm::vec3(0.0f); }

bool absorbs(const CoreMaterial& material) {
    return !material.thin_walled && material.transmission > 0.0f && material.absorption != glm::vec3(0.0f);
}

bool has_alpha_texture(const CoreMaterial& material) {
    return material.base_color_texture.texture != render_system::NONE;
}

uint pack_tangent(const glm::vec4& t) {
    float sum = std::fabs(t.x) + std::fabs(t.y) + std::fabs(t.z);
    float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
    float x = t.x * scale;
    float y = t.y * scale;
    if (t.z < 0.0f) {
        float folded_x = (1.0f - std::fabs(y)) * (x >= 0.0f ? 1.0f : -1.0f);
        y = (1.0f - std::fabs(x)) * (y >= 0.0f ? 1.0f : -1.0f);
        x = folded_x;
    }
    uint word_x = static_cast<uint>(std::lround((x * 0.5f + 0.5f) * static_cast<float>(TANGENT_X_MASK)));
    uint word_y = static_cast<uint>(std::lround((y * 0.5f + 0.5f) * static_cast<float>(TANGENT_Y_MASK)));
    return word_x | word_y << TANGENT_Y_SHIFT | (t.w < 0.0f ? 1u : 0u) << TANGENT_SIGN_SHIFT;
}

}  // namespace

void pack_materials(std::span<const CoreMaterial> materials, SceneTables& tables) {
    tables.materials.clear();
    tables.texture_slots.clear();
    for (const CoreMaterial& material : materials) {
        uint flags = (material.opaque ? MATERIAL_OPAQUE : 0u) | (material.double_sided ? MATERIAL_DOUBLE_SIDED : 0u) |
                     (material.thin_walled ? MATERIAL_THIN_WALLED : 0u);
        float slots[16] = {};
        static_assert(std::size(kTextureSlots) <= std::size(slots));
        for (uint i = 0; i < std::size(kTextureSlots); ++i) {
            slots[i] = as_float(pack_slot(material.*kTextureSlots[i], tables.texture_slots));
        }
        vec4 rows[MATERIAL_ROWS];
        rows[MATERIAL_BASE_COLOR] = row(material.base_color, material.alpha);
        rows[MATERIAL_SURFACE] = vec4(material.metallic, material.roughness, material.specular, material.transmission);
        rows[MATERIAL_EMISSION] = row(material.emission, material.emission_weight);
        rows[MATERIAL_SPECULAR] = row(material.specular_color, bending_ior(material));
        rows[MATERIAL_ALPHA] = vec4(material.normal_scale, material.alpha_cutoff, as_float(flags),
                                    as_float(tables.energies.row_of(material)));
        rows[MATERIAL_SLOTS] = vec4(slots[0], slots[1], slots[2], slots[3]);
        rows[MATERIAL_MORE_SLOTS] = vec4(slots[4], slots[5], slots[6], slots[7]);
        rows[MATERIAL_SHEEN] = row(material.sheen_color, material.sheen_roughness);
        uint sheen_row = has_sheen(material) ? tables.energies.sheen_row() : 0u;
        rows[MATERIAL_LOBES] =
            vec4(as_float(sheen_row), material.coat, material.coat_roughness, material.coat_normal_scale);
        rows[MATERIAL_LOBE_SLOTS] = vec4(slots[8], slots[9], slots[10], slots[11]);
        rows[MATERIAL_FILM] =
            vec4(material.film, material.film_ior, material.film_thickness.x, material.film_thickness.y);
        rows[MATERIAL_FILM_SLOTS] = vec4(slots[12], slots[13], slots[14], slots[15]);
        rows[MATERIAL_VOLUME] = row(material.absorption, 0.0f);
        uint stretched_row = material.anisotropy > 0.0f ? tables.energies.stretched_row() : 0u;
        rows[MATERIAL_ANISOTROPY] =
            vec4(material.anisotropy, as_float(stretched_row), std::cos(material.anisotropy_rotation),
                 std::sin(material.anisotropy_rotation));
        tables.materials.insert(tables.materials.end(), rows, rows + MATERIAL_ROWS);
    }
    tables.lobe_energy.clear();
    for (const glm::vec4& cell : tables.energies.rows()) {
        tables.lobe_energy.push_back(row(glm::vec3(cell), cell.w));
    }
}

void pack_textures(std::span<const CoreTexture> textures, SceneTables& tables) {
    tables.textures.assign(textures.size(), uvec4(0u));
    size_t texels = 0;
    for (const CoreTexture& texture : textures) {
        texels += texture.texels.size();
    }
    give_back(tables.texels);
    tables.texels.reserve(texels);  // growing would take as much again
    tables.texture_features = 0;
    for (size_t i = 0; i < textures.size(); ++i) {
        const CoreTexture& texture = textures[i];
        uint wrap_s = static_cast<uint>(texture.wrap_s) << TEXTURE_WRAP_S_SHIFT;
        uint wrap_t = static_cast<uint>(texture.wrap_t) << TEXTURE_WRAP_T_SHIFT;
        uint nearest = (texture.nearest ? 1u : 0u) << TEXTURE_NEAREST_SHIFT;
        float texels_of_level_0 = static_cast<float>(texture.width) * static_cast<float>(texture.height);
        tables.textures[i] =
            uvec4(static_cast<uint>(texture.format) | wrap_s | wrap_t | nearest, std::bit_cast<uint>(texels_of_level_0),
                  texture.levels, static_cast<uint>(tables.textures.size()));
        uint first = static_cast<uint>(tables.texels.size());
        for (uint level = 0; level < texture.levels; ++level) {
            uint width = std::max(1u, texture.width >> level);
            uint height = std::max(1u, texture.height >> level);
            tables.textures.push_back(uvec4(first, width, height, 0u));
            first += width * height * texel_words(texture.format);
        }
        tables.texture_features |= texel_words(texture.format) > 1 ? FEATURE_DEEP_TEXELS : 0u;
        tables.texels.insert(tables.texels.end(), texture.texels.begin(), texture.texels.end());
    }
}

void pack_lights(const CoreLights& lights, SceneTables& tables) {
    tables.lights.clear();
    tables.light_table.clear();
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        const CoreLight& light = lights.lights[i];
        bool triangle = light.kind == LightKind::triangle;
        vec4 rows[LIGHT_ROWS];
        rows[LIGHT_POSITION] = row(light.vertices[0], as_float(static_cast<uint>(light.kind)));
        rows[LIGHT_VERTEX1] = row(triangle ? light.vertices[1] : light.direction, as_float(light.two_sided ? 1u : 0u));
        rows[LIGHT_VERTEX2] = triangle ? row(light.vertices[2], lights.table[i].probability * 2.0f)
                                       : vec4(light.spot_scale, light.spot_offset, 0.0f, 0.0f);
        rows[LIGHT_EMISSION] = row(light.emission, as_float(light.emission_texture.texture));
        rows[LIGHT_UV01] = vec4(light.uv[0].x, light.uv[0].y, light.uv[1].x, light.uv[1].y);
        rows[LIGHT_UV2] = vec4(light.uv[2].x, light.uv[2].y, 0.0f, 0.0f);
        tables.lights.insert(tables.lights.end(), rows, rows + LIGHT_ROWS);
        tables.light_table.push_back(pack_alias(lights.table[i]));
    }
}

void pack_sky(const CoreSky& sky, SceneTables& tables) {
    tables.sky_texels.clear();
    tables.sky_table.clear();
    for (size_t i = 0; i < sky.texels.size(); ++i) {
        tables.sky_texels.push_back(row(glm::vec3(sky.texels[i]), sky.table[i].probability));
        tables.sky_table.push_back(pack_alias(sky.table[i]));
    }
}

bool has_more_uv(const CoreMesh& mesh) { return !mesh.uv2.empty() || !mesh.uv3.empty(); }

uint vertex_flags(const CoreMesh& mesh) {
    return (mesh.tangents.empty() ? 0u : INSTANCE_HAS_TANGENTS) |
           (mesh.uv0.empty() && mesh.uv1.empty() && !has_more_uv(mesh) ? 0u : INSTANCE_HAS_UV) |
           (has_more_uv(mesh) ? INSTANCE_HAS_MORE_UV : 0u) | (mesh.colors.empty() ? 0u : INSTANCE_HAS_COLORS);
}

size_t vertex_row_count(const CoreMesh& mesh) {
    const uint flags = vertex_flags(mesh);
    return mesh.positions.size() * (1u + (flags >> INSTANCE_UV_SHIFT & 1u) + (flags >> INSTANCE_MORE_UV_SHIFT & 1u) +
                                    (flags >> INSTANCE_COLORS_SHIFT & 1u));
}

void pack_vertices(const CoreMesh& mesh, vec4* rows) {
    const uint flags = vertex_flags(mesh);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        *rows++ = row(mesh.normals[i], as_float(mesh.tangents.empty() ? 0u : pack_tangent(mesh.tangents[i])));
        if ((flags & INSTANCE_HAS_UV) != 0u) {
            glm::vec2 uv0 = mesh.uv0.empty() ? glm::vec2(0.0f) : mesh.uv0[i];
            glm::vec2 uv1 = mesh.uv1.empty() ? glm::vec2(0.0f) : mesh.uv1[i];
            *rows++ = vec4(uv0.x, uv0.y, uv1.x, uv1.y);
        }
        if ((flags & INSTANCE_HAS_MORE_UV) != 0u) {
            glm::vec2 uv2 = mesh.uv2.empty() ? glm::vec2(0.0f) : mesh.uv2[i];
            glm::vec2 uv3 = mesh.uv3.empty() ? glm::vec2(0.0f) : mesh.uv3[i];
            *rows++ = vec4(uv2.x, uv2.y, uv3.x, uv3.y);
        }
        if ((flags & INSTANCE_HAS_COLORS) != 0u) {
            *rows++ = row(glm::vec3(mesh.colors[i]), mesh.colors[i].w);
        }
    }
}

void pack_instance(const CoreTransform& transform, uint first_triangle, uint first_vertex_row, uint flags, vec4* rows) {
    glm::vec3 a(transform.rows[0]);
    glm::vec3 b(transform.rows[1]);
    glm::vec3 c(transform.rows[2]);
    float mirrored = glm::dot(a, glm::cross(b, c)) < 0.0f ? -1.0f : 1.0f;
    for (uint i = 0; i < 3; ++i) {
        rows[INSTANCE_TRANSFORM + i] = row(glm::vec3(transform.rows[i]), transform.rows[i].w);
    }
    rows[INSTANCE_MESH] = vec4(as_float(first_triangle), as_float(first_vertex_row), as_float(flags), mirrored);
}

float opacity_code(const CoreMaterial& material, bool mesh_has_colors) {
    if (material.opaque) {
        return 1.0f;
    }
    if (has_alpha_texture(material) || mesh_has_colors) {
        return -1.0f;
    }
    if (material.alpha_cutoff > 0.0f) {
        return material.alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
    }
    return material.alpha;
}

uint material_features(std::span<const CoreMaterial> materials) {
    uint features = 0;
    auto raise = [&features](bool condition, uint bits) { features |= condition ? bits : 0u; };
    for (const CoreMaterial& material : materials) {
        for (uint i = 0; i < std::size(kTextureSlots); ++i) {
            const CoreTextureSlot& slot = material.*kTextureSlots[i];
            raise(slot.texture != render_system::NONE, kSlotFeatures[i]);
            raise(slot.texture != render_system::NONE && slot.uv_set > 1, FEATURE_MORE_UV);
        }
        raise(material.transmission > 0.0f && !material.thin_walled, FEATURE_TRANSMISSION);
        raise(has_sheen(material), FEATURE_SHEEN);
        raise(material.coat > 0.0f, FEATURE_COAT);
        raise(material.film > 0.0f, FEATURE_FILM);
        raise(absorbs(material), FEATURE_VOLUME);
        raise(material.anisotropy > 0.0f, FEATURE_ANISOTROPY);
    }
    return features;
}

uint light_features(const CoreLights& lights) {
    uint features = lights.lights.empty() ? 0u : FEATURE_LIGHTS;
    for (const CoreLight& light : lights.lights) {
        bool punctual =
            light.kind == LightKind::point || light.kind == LightKind::spot || light.kind == LightKind::directional;
        features |= punctual ? FEATURE_PUNCTUAL_LIGHTS : 0u;
    }
    return features;
}

}  // namespace target_core

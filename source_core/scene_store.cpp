// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/scene_store.h"

#include <algorithm>
#include <chrono>

#include "source_core/scene_buffers.h"

namespace source_core {

using namespace render_system;

namespace {

// The tree's share, a little above what real scenes need; it is known only once the tree is built.
constexpr uint64_t NODE_BYTES_PER_TRIANGLE = 32;

uint64_t least_bytes_of(const CoreMeshCopy& mesh) { return least_bytes(mesh.triangles.size(), mesh.positions.size()); }

}  // namespace

void SceneStore::mark(std::initializer_list<uint32_t> tables) {
    for (const uint32_t table : tables) {
        changed_[table] = true;
        bytes_[table] = rows(table).size();
    }
}

void SceneStore::set_textures(std::span<const CoreTexture> textures) {
    pack_textures(textures, tables_);
    mark({BINDING_TEXTURES, BINDING_TEXELS});
}

void SceneStore::set_materials(uint32_t first, std::span<const CoreMaterial> materials) {
    materials_.resize(std::max(materials_.size(), first + materials.size()));
    std::copy(materials.begin(), materials.end(), materials_.begin() + first);
    materials_changed_ = true;
}

void SceneStore::set_lights(const CoreLights& lights) {
    pack_lights(lights, tables_);
    light_features_ = light_features(lights);
    light_weight_scale_ = lights.total_weight > 0.0f ? 1.0f / lights.total_weight : 0.0f;
    light_count_ = static_cast<uint32_t>(lights.lights.size());
    mark({BINDING_LIGHTS, BINDING_LIGHT_TABLE});
}

void SceneStore::set_sky(const CoreSky& sky) {
    pack_sky(sky, tables_);
    sky_radiance_ = sky.radiance;
    sky_width_ = sky.width;
    sky_height_ = sky.height;
    sky_light_probability_ = sky.light_probability;
    mark({BINDING_SKY_TEXELS, BINDING_SKY_TABLE});
}

void SceneStore::set_mesh(uint32_t mesh, const CoreMesh& data) {
    if (mesh == meshes_.size()) {
        meshes_.emplace_back();
    }
    CoreMeshCopy& copy = meshes_[mesh];
    mesh_bytes_ -= least_bytes_of(copy);
    copy.positions.assign(data.positions.begin(), data.positions.end());
    copy.triangles.assign(data.triangles.begin(), data.triangles.end());
    copy.vertex_rows = pack_vertices(data);
    copy.tangents = pack_tangents(data);
    copy.has_tangents = !data.tangents.empty();
    copy.has_colors = !data.colors.empty();
    mesh_bytes_ += least_bytes_of(copy);
    geometry_changed_ = true;
}

void SceneStore::set_instance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) {
    if (instance == instances_.size()) {
        instances_.emplace_back();
    }
    instances_[instance] = {mesh, transform};
    geometry_changed_ = true;
}

uint64_t SceneStore::plain_table_bytes() const {
    uint64_t sum = instances_.size() * INSTANCE_ROWS * sizeof(glm::vec4);
    for (uint32_t table = BINDING_MATERIALS; table < TABLE_COUNT; ++table) {
        sum += table_bytes(bytes_[table]);
    }
    return sum;
}

uint64_t SceneStore::least_table_bytes() const { return mesh_bytes_ + plain_table_bytes(); }

uint64_t SceneStore::likely_table_bytes() const {
    uint64_t triangles = 0;
    for (const CoreMeshCopy& mesh : meshes_) {
        triangles += mesh.triangles.size();
    }
    return least_table_bytes() + triangles * NODE_BYTES_PER_TRIANGLE;
}

void SceneStore::update_opacities() {
    std::vector<OpacityCodes> codes;
    for (const CoreMaterial& material : materials_) {
        codes.push_back({opacity_code(material, false), opacity_code(material, true)});
    }
    geometry_changed_ = geometry_changed_ || codes != opacities_;
    opacities_ = std::move(codes);
}

Status SceneStore::update_geometry(uint32_t threads) {
    const auto start = std::chrono::steady_clock::now();
    const OpacityOf opacity_of = [this](uint32_t material, bool colored) {
        return colored ? opacities_[material].colored : opacities_[material].plain;
    };
    Result<GeometryTables> built = build_geometry(meshes_, instances_, opacity_of, threads);
    if (!built.ok()) {
        return built.status;
    }
    geometry_ = std::move(*built);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    build_ms_ = taken.count();
    mark({BINDING_NODES, BINDING_TRIANGLES, BINDING_MESH_TRIANGLES, BINDING_VERTICES, BINDING_TANGENTS,
          BINDING_INSTANCES});
    geometry_changed_ = false;
    return Status::success();
}

Status SceneStore::build(uint32_t threads) {
    if (materials_changed_) {
        update_opacities();
        pack_materials(materials_, tables_);
        mark({BINDING_MATERIALS, BINDING_TEXTURE_SLOTS, BINDING_LOBE_ENERGY});
        materials_changed_ = false;
    }
    return geometry_changed_ ? update_geometry(threads) : Status::success();
}

std::span<const std::byte> SceneStore::rows(uint32_t table) const {
    const auto bytes = [](const auto& rows) { return std::as_bytes(std::span(rows)); };
    switch (table) {
        case BINDING_NODES:
            return bytes(geometry_.nodes);
        case BINDING_TRIANGLES:
            return bytes(geometry_.triangles);
        case BINDING_MESH_TRIANGLES:
            return bytes(geometry_.mesh_triangles);
        case BINDING_VERTICES:
            return bytes(geometry_.vertices);
        case BINDING_TANGENTS:
            return bytes(geometry_.tangents);
        case BINDING_INSTANCES:
            return bytes(geometry_.instances);
        case BINDING_MATERIALS:
            return bytes(tables_.materials);
        case BINDING_TEXTURE_SLOTS:
            return bytes(tables_.texture_slots);
        case BINDING_TEXTURES:
            return bytes(tables_.textures);
        case BINDING_TEXELS:
            return bytes(tables_.texels);
        case BINDING_LIGHTS:
            return bytes(tables_.lights);
        case BINDING_LIGHT_TABLE:
            return bytes(tables_.light_table);
        case BINDING_SKY_TEXELS:
            return bytes(tables_.sky_texels);
        case BINDING_SKY_TABLE:
            return bytes(tables_.sky_table);
        case BINDING_LOBE_ENERGY:
            return bytes(tables_.lobe_energy);
        default:
            return {};
    }
}

void SceneStore::uploaded() {
    changed_.fill(false);
    geometry_.nodes = {};
    geometry_.triangles = {};
    geometry_.mesh_triangles = {};
    geometry_.vertices = {};
    geometry_.tangents = {};
    geometry_.instances = {};
}

void SceneStore::describe(Settings& settings) const {
    settings.sky_radiance = glm::vec4(sky_radiance_, 0.0f);
    settings.scene_extent = glm::vec4(geometry_.extent, 0.0f);
    settings.light_count = light_count_;
    settings.features = features();
    settings.sky_width = sky_width_;
    settings.sky_height = sky_height_;
    settings.sky_light_probability = sky_light_probability_;
    settings.light_weight_scale = light_weight_scale_;
}

uint32_t SceneStore::features() const {
    return material_features(materials_) | light_features_ | geometry_.features |
           (sky_width_ > 0 ? FEATURE_SKY_MAP : 0u);
}

}  // namespace source_core

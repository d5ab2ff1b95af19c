// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/scene_store.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "render_system/give_back.h"
#include "source_core/scene_buffers.h"

namespace source_core {

using namespace render_system;

namespace {

// The tree's share, a little above what real scenes need; it is known only once the tree is built.
constexpr uint64_t NODE_BYTES_PER_TRIANGLE = 32;

uint64_t least_bytes_of(const CoreMeshCopy& mesh) {
    return least_bytes(mesh.triangles.size(), mesh.vertex_rows.size());
}

// Raises a flag by id.
void raise(std::vector<bool>& flags, uint32_t id) {
    flags.resize(std::max<size_t>(flags.size(), size_t{id} + 1), false);
    flags[id] = true;
}

// Whether only the vertices differ.
bool same_shape(const CoreMeshCopy& mesh, const CoreMesh& data) {
    return mesh.positions.size() == data.positions.size() && mesh.flags == vertex_flags(data) &&
           std::equal(mesh.triangles.begin(), mesh.triangles.end(), data.triangles.begin(), data.triangles.end());
}

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
        geometry_changed_ = true;  // also without a triangle: it is not there to be moved
    }
    CoreMeshCopy& copy = meshes_[mesh];
    if (data.moves) {
        raise(moving_.placed, mesh);
    }
    if (data.deforms) {
        raise(moving_.meshes, mesh);
    }
    const bool deforms = !geometry_changed_ && same_shape(copy, data);
    if (deforms) {
        std::copy(data.positions.begin(), data.positions.end(), copy.positions.begin());
        pack_vertices(data, copy.vertex_rows.data());
        raise(moving_.meshes, mesh);
        deformed_.push_back(mesh);
        return;
    }
    mesh_bytes_ -= least_bytes_of(copy);
    copy.positions = {data.positions.begin(), data.positions.end()};  // no more room than that
    copy.triangles = {data.triangles.begin(), data.triangles.end()};
    give_back(copy.vertex_rows);
    copy.vertex_rows.resize(vertex_row_count(data));
    pack_vertices(data, copy.vertex_rows.data());
    copy.flags = vertex_flags(data);
    mesh_bytes_ += least_bytes_of(copy);
    geometry_changed_ = true;
}

std::vector<glm::vec3> SceneStore::positions_before(uint32_t mesh, const CoreMesh& data) const {
    if (mesh >= meshes_.size() || !same_shape(meshes_[mesh], data)) return {};
    return meshes_[mesh].positions;
}

void SceneStore::set_instance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) {
    if (instance == instances_.size()) {
        instances_.emplace_back();
        geometry_changed_ = true;
    }
    if (instances_[instance].mesh == mesh && instances_[instance].transform == transform && !geometry_changed_) {
        return;
    }
    const bool moves = !geometry_changed_ && instances_[instance].mesh == mesh;
    instances_[instance] = {mesh, transform};
    geometry_changed_ = geometry_changed_ || !moves;
    if (moves && mesh != NONE) {
        raise(moving_.instances, instance);
        moved_.push_back(instance);
    }
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
    // No triangle that is built names a material that is new.
    geometry_changed_ = geometry_changed_ || codes.size() < opacities_.size() ||
                        !std::equal(opacities_.begin(), opacities_.end(), codes.begin());
    opacities_ = std::move(codes);
}

OpacityOf SceneStore::opacity_function() const {
    return [this](uint32_t material, bool colored) {
        return colored ? opacities_[material].colored : opacities_[material].plain;
    };
}

Status SceneStore::rebuild_geometry(uint32_t threads) {
    Result<GeometryTables> built = build_geometry(meshes_, instances_, opacity_function(), threads, moving_);
    if (!built.ok()) {
        return built.status;
    }
    geometry_ = std::move(*built);
    patches_.clear();
    mark({BINDING_NODES, BINDING_TRIANGLES, BINDING_MESH_TRIANGLES, BINDING_VERTICES, BINDING_INSTANCES});
    bytes_[BINDING_NODES] += geometry_.plan.spare_count * sizeof(WideNode);
    return Status::success();
}

// Touches what has moved alone; false where that does not do.
bool SceneStore::move_geometry(uint32_t threads) {
    auto update = update_geometry(meshes_, instances_, moved_, deformed_, opacity_function(), threads, geometry_.plan);
    if (!update) {
        return false;
    }
    geometry_.extent = update->extent;
    std::move(update->patches.begin(), update->patches.end(), std::back_inserter(patches_));
    return true;
}

// What lies in one place; after an update only what moved is looked at.
void SceneStore::find_coincident(bool anew) {
    std::vector<PlacedMesh> scene(instances_.size());
    std::vector<uint32_t> changed = moved_;
    for (uint32_t i = 0; i < instances_.size(); ++i) {
        const CoreInstance& instance = instances_[i];
        if (instance.mesh == NONE || meshes_[instance.mesh].triangles.empty()) {
            continue;
        }
        const CoreMeshCopy& mesh = meshes_[instance.mesh];
        scene[i] = {&mesh.positions[0].x, static_cast<uint32_t>(mesh.positions.size()), &mesh.triangles[0].x,
                    static_cast<uint32_t>(mesh.triangles.size()), instance.transform.rows};
        if (std::count(deformed_.begin(), deformed_.end(), instance.mesh) > 0) {
            changed.push_back(i);
        }
    }
    if (anew) {
        coincident_.find(scene);
    } else {
        coincident_.follow(scene, changed);
    }
    coincident_rows_ = pack_coincident(coincident_.entries(), [this](const TriangleName& name) {
        const uint32_t mesh = instances_[name.instance].mesh;
        const uint32_t material = meshes_[mesh].triangles[name.primitive].w;
        return CoincidentTriangle{geometry_.plan.slot_of(name.instance, mesh, name.primitive),
                                  opacity_function()(material, meshes_[mesh].has_colors())};
    });
    mark({BINDING_COINCIDENT});
}

Status SceneStore::build(uint32_t threads) {
    if (materials_changed_) {
        update_opacities();
        pack_materials(materials_, tables_);
        mark({BINDING_MATERIALS, BINDING_TEXTURE_SLOTS, BINDING_LOBE_ENERGY});
        materials_changed_ = false;
    }
    if (!geometry_changed_ && moved_.empty() && deformed_.empty()) {
        return Status::success();
    }
    const auto start = std::chrono::steady_clock::now();
    const bool anew = geometry_changed_;
    // What is half done by an update that fails is overwritten by a build.
    geometry_changed_ = geometry_changed_ || !move_geometry(threads);
    if (geometry_changed_) {
        if (Status status = rebuild_geometry(threads); !status.ok()) {
            return status;
        }
    }
    find_coincident(anew);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    build_ms_ = taken.count();
    geometry_changed_ = false;
    moved_.clear();
    deformed_.clear();
    return Status::success();
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
        case BINDING_COINCIDENT:
            return bytes(coincident_rows_);
        default:
            return {};
    }
}

void SceneStore::uploaded() {
    changed_.fill(false);
    patches_.clear();
    give_back(geometry_.nodes);
    give_back(geometry_.triangles);
    give_back(geometry_.mesh_triangles);
    give_back(geometry_.vertices);
    give_back(geometry_.instances);
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
    return material_features(materials_) | tables_.texture_features | light_features_ | geometry_.features |
           (sky_width_ > 0 ? FEATURE_SKY_MAP : 0u) | (coincident_.empty() ? 0u : FEATURE_COINCIDENT);
}

}  // namespace source_core

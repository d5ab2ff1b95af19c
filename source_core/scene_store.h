// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "render_system/coincident.h"
#include "render_system/core_data.h"
#include "render_system/status.h"
#include "source_core/core_geometry.h"
#include "source_core/core_tables.h"
#include "source_core/kernels/bindings.h"

namespace source_core {

/// The scene as it was handed over, and what has to be built or uploaded because of it. Knows no device.
class SceneStore {
public:
    void set_textures(std::span<const render_system::CoreTexture> textures);
    void set_materials(uint32_t first, std::span<const render_system::CoreMaterial> materials);
    void set_lights(const render_system::CoreLights& lights);
    void set_sky(const render_system::CoreSky& sky);
    void set_mesh(uint32_t mesh, const render_system::CoreMesh& data);
    /// Where the vertices of a mesh are, if `data` moves them and changes nothing else; else none.
    std::vector<glm::vec3> positions_before(uint32_t mesh, const render_system::CoreMesh& data) const;
    void set_instance(uint32_t instance, uint32_t mesh, const render_system::CoreTransform& transform);

    /// Bytes that the tables take at least, before anything is built.
    uint64_t least_table_bytes() const;
    /// The same with a tree of the usual size.
    uint64_t likely_table_bytes() const;

    /// Builds what changed. Afterwards rows() of the tables marked in changed() are there, and bytes() of all.
    render_system::Status build(uint32_t threads);
    bool changed(uint32_t table) const { return changed_[table]; }
    /// Parts of tables that are on the device already, to be put in place after all that changed() marks.
    const std::vector<TablePatch>& patches() const { return patches_; }
    std::span<const std::byte> bytes_of(const TablePatch& patch) const { return source_core::bytes_of(patch, meshes_); }
    std::span<const std::byte> rows(uint32_t table) const;
    uint64_t bytes(uint32_t table) const { return bytes_[table]; }
    /// To be called when everything is on the device: drops what only an upload needs.
    void uploaded();

    /// Fills the fields of the settings that follow from the scene.
    void describe(Settings& settings) const;
    uint32_t features() const;
    double build_ms() const { return build_ms_; }

private:
    struct OpacityCodes {
        float plain;
        float colored;  // on a mesh with vertex colours
        bool operator==(const OpacityCodes&) const = default;
    };

    void mark(std::initializer_list<uint32_t> tables);
    void update_opacities();
    render_system::Status rebuild_geometry(uint32_t threads);
    bool move_geometry(uint32_t threads);
    void find_coincident(bool anew);
    OpacityOf opacity_function() const;
    uint64_t plain_table_bytes() const;

    std::vector<CoreMeshCopy> meshes_;
    std::vector<CoreInstance> instances_;
    std::vector<render_system::CoreMaterial> materials_;
    SceneTables tables_;
    GeometryTables geometry_;
    render_system::CoincidentSurfaces coincident_;
    std::vector<glm::uvec4> coincident_rows_;
    MovingParts moving_;
    std::vector<uint32_t> moved_;     // instances, since the last build
    std::vector<uint32_t> deformed_;  // meshes
    std::vector<TablePatch> patches_;
    std::vector<OpacityCodes> opacities_;
    std::array<bool, TABLE_COUNT> changed_{};
    std::array<uint64_t, TABLE_COUNT> bytes_{};
    uint64_t mesh_bytes_ = 0;  // least_bytes of all meshes
    uint32_t light_features_ = 0;
    float light_weight_scale_ = 0.0f;
    uint32_t light_count_ = 0;
    glm::vec3 sky_radiance_{0.0f};
    uint32_t sky_width_ = 0;
    uint32_t sky_height_ = 0;
    float sky_light_probability_ = 0.0f;
    double build_ms_ = 0.0;
    bool geometry_changed_ = true;
    bool materials_changed_ = true;
};

}  // namespace source_core

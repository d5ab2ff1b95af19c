// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render_system/core_api.h"
#include "render_system/frame_before.h"
#include "render_system/scene_limits.h"

// What core_api.h says must fail, checked in one place, so that all cores refuse the same things in the same words.

namespace render_system {

/// Texels in a mip chain of that size; 0 if a side is 0, or levels is 0 or more than the chain can have.
uint64_t mip_chain_texels(uint32_t width, uint32_t height, uint32_t levels);

Status validate_target(const CoreTarget& target);
Status validate_settings(const CoreSettings& settings);
Status validate_texture(const CoreTexture& texture);
Status validate_mesh(const CoreMesh& mesh);
Status validate_transform(const CoreTransform& transform);
Status validate_lights(const CoreLights& lights);
Status validate_sky(const CoreSky& sky);

/// Keeps just enough of what a core was given to hold the next call against the contract. CheckedCore owns one, asks
/// `check_*` first, lets the core do its work, and says `accept_*` once that has succeeded. Nothing here changes in
/// `check_*`, so a failed call leaves what was set before.
class CoreContract {
public:
    Status check_init() const;
    Status check_target(const CoreTarget& target) const;
    Status check_settings(const CoreSettings& settings) const;
    Status check_textures(std::span<const CoreTexture> textures) const;
    Status check_materials(uint32_t first, std::span<const CoreMaterial> materials) const;
    Status check_lights(const CoreLights& lights) const;
    Status check_sky(const CoreSky& sky) const;
    Status check_geometry(uint32_t mesh, const CoreMesh& data) const;
    Status check_instance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) const;
    Status check_watch() const;
    Status check_history() const;
    /// Order, the number of samples, dangling ids (a triangle's material, a material's or a light's texture), then what
    /// scene_limits.h bounds.
    Status check_render(const ViewPyramid& view, uint32_t samples) const;
    /// As check_render, and the spans of the filter.
    Status check_filter(const ViewPyramid& view, const CoreFilter& filter, const CoreTarget& target) const;

    void accept_init();
    void accept_target();
    void accept_textures(std::span<const CoreTexture> textures);
    void accept_materials(uint32_t first, std::span<const CoreMaterial> materials);
    void accept_lights(const CoreLights& lights);
    void accept_geometry(uint32_t mesh, const CoreMesh& data);
    void accept_instance(uint32_t instance, uint32_t mesh, const CoreTransform& transform);
    void accept_shutdown();

    /// All instances, as they are.
    const std::vector<PlacedInstance>& instances() const { return instances_; }

    /// Triangles in all visible instances.
    uint64_t triangles() const;

private:
    enum class Stage { created, open, closed };
    struct Mesh {
        uint64_t triangles = 0;
        uint32_t last_material = 0;  // the largest index used
        Box box;                     // in its own space
    };
    // Of all visible instances.
    struct Extent {
        Placement farthest;
        size_t farthest_instance = 0;
        Placement smallest;   // the one whose inverse enlarges most
        double offset = 0.0;  // the largest
    };
    Status check_open(const char* call) const;
    Status check_limits(const ViewPyramid& view) const;
    const Extent& extent() const;

    Stage stage_ = Stage::created;
    bool has_target_ = false;
    uint64_t textures_ = 0;
    std::vector<Mesh> meshes_;
    std::vector<PlacedInstance> instances_;
    mutable std::optional<Extent> extent_;  // none: something has changed
    std::vector<uint32_t> last_textures_;   // of each material: the largest texture index + 1
    uint32_t lights_last_texture_ = 0;      // the largest texture index + 1
};

}  // namespace render_system

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/core_checks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "render_system/scene_limits.h"

namespace render_system {

namespace {

Status unequal(const char* what, uint64_t got, uint64_t wanted) {
    return Status::invalid(std::string("mesh: ") + what + " has " + std::to_string(got) + " elements, but there are " +
                           std::to_string(wanted) + " positions");
}

std::array<std::pair<const char*, std::span<const glm::vec2>>, 4> uv_sets_of(const CoreMesh& mesh) {
    return {{{"uv0", mesh.uv0}, {"uv1", mesh.uv1}, {"uv2", mesh.uv2}, {"uv3", mesh.uv3}}};
}

bool finite(const glm::vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

template <class T>
bool all_finite(std::span<const T> values) {
    // By the exponent's bits and without a way out, so that compilers make vectors of it.
    constexpr uint32_t EXPONENT = 0x7F800000u;
    uint32_t found = 0;
    for (const T& value : values) {
        for (int c = 0; c < T::length(); ++c) {
            found |= (std::bit_cast<uint32_t>(value[c]) & EXPONENT) == EXPONENT ? 1u : 0u;
        }
    }
    return found == 0;
}

// Nothing that a ray could start from or be bent by may be infinite or NaN: Embree ends the process over such rays.
Status validate_values(const CoreMesh& mesh) {
    const char* wrong = !all_finite(mesh.positions)  ? "positions"
                        : !all_finite(mesh.normals)  ? "normals"
                        : !all_finite(mesh.tangents) ? "tangents"
                        : !all_finite(mesh.colors)   ? "colors"
                                                     : nullptr;
    if (wrong) return Status::invalid(std::string("mesh: ") + wrong + " holds an element that is not finite");
    for (const auto& [name, set] : uv_sets_of(mesh)) {
        if (within_texture(set)) continue;
        return Status::invalid(std::string("mesh: ") + name +
                               " holds a texture coordinate past 1e8, or one that is no number");
    }
    return Status::success();
}

Status validate_light(const CoreLight& light) {
    const int vertices = light.kind == LightKind::triangle                                 ? 3
                         : light.kind == LightKind::point || light.kind == LightKind::spot ? 1
                                                                                           : 0;
    for (int i = 0; i < vertices; ++i) {
        if (Status status = check_light_position(light.vertices[i]); !status.ok()) return status;
    }
    if (!all_finite(std::span<const glm::vec3>(&light.direction, 1)) || !is_light(light.emission))
        return Status::invalid("its direction is not finite, or its emission not a number from 0 to 1e12");
    return Status::success();
}

Status validate_table(std::span<const AliasEntry> table, const char* owner) {
    for (size_t i = 0; i < table.size(); ++i) {
        if (table[i].alias >= table.size()) {
            return Status::invalid(std::string(owner) + ": entry " + std::to_string(i) + " of the table names " +
                                   std::to_string(table[i].alias) + ", past its end");
        }
    }
    return Status::success();
}

// The largest texture index that a material uses, plus one; 0 if it uses none.
uint32_t last_texture(const CoreMaterial& m) {
    uint32_t last = 0;
    for (const auto slot : kTextureSlots) {
        if ((m.*slot).texture != NONE) last = std::max(last, (m.*slot).texture + 1);
    }
    return last;
}

}  // namespace

uint64_t mip_chain_texels(uint32_t width, uint32_t height, uint32_t levels) {
    if (width == 0 || height == 0 || levels == 0) return 0;
    uint64_t texels = 0;
    for (uint32_t level = 0; level < levels; ++level) {
        // Past the 1x1 level there is nothing.
        if (level > 0 && (level > 31 || ((width >> level) == 0 && (height >> level) == 0))) return 0;
        texels += static_cast<uint64_t>(std::max(1u, width >> level)) * std::max(1u, height >> level);
    }
    return texels;
}

Status validate_target(const CoreTarget& target) {
    if (target.width == 0 || target.height == 0) {
        return Status::invalid("target: the size is " + std::to_string(target.width) + "x" +
                               std::to_string(target.height) + "; both sides must be at least 1");
    }
    const uint64_t wanted = static_cast<uint64_t>(target.width) * target.height;
    if (target.pixels.size() != wanted) {
        return Status::invalid("target: " + std::to_string(target.pixels.size()) + " pixels for a size of " +
                               std::to_string(target.width) + "x" + std::to_string(target.height));
    }
    if (target.sums.size() > wanted || target.first_pixel > wanted - target.sums.size()) {
        return Status::invalid("target: " + std::to_string(target.sums.size()) + " sums from pixel " +
                               std::to_string(target.first_pixel) + " on for " + std::to_string(wanted) + " pixels");
    }
    if (!target.squares.empty() && target.squares.size() != target.sums.size()) {
        return Status::invalid("target: " + std::to_string(target.squares.size()) + " squares for " +
                               std::to_string(target.sums.size()) + " sums");
    }
    return Status::success();
}

Status validate_settings(const CoreSettings& settings) {
    if (settings.max_path_length == 0) return Status::invalid("settings: max_path_length is 0; it must be at least 1");
    if (!(settings.indirect_limit >= 0.0f && std::isfinite(settings.indirect_limit)))
        return Status::invalid("settings: indirect_limit is negative or not finite");
    return Status::success();
}

Status validate_texture(const CoreTexture& texture) {
    const std::string size = std::to_string(texture.width) + "x" + std::to_string(texture.height) + " with " +
                             std::to_string(texture.levels) + " levels";
    const uint64_t wanted = mip_chain_texels(texture.width, texture.height, texture.levels);
    if (wanted == 0) return Status::invalid("texture: " + size + " is no mip chain");
    const uint32_t words = texel_words(texture.format);
    if (texture.texels.size() != wanted * words) {
        return Status::invalid("texture: " + std::to_string(texture.texels.size() / words) + " texels, but " + size +
                               " needs " + std::to_string(wanted));
    }
    return Status::success();
}

Status validate_mesh(const CoreMesh& mesh) {
    const size_t vertices = mesh.positions.size();
    if (vertices >= NONE) return Status::invalid("mesh: more vertices than a 32-bit index can name");
    if (mesh.triangles.size() >= NONE) return Status::invalid("mesh: more triangles than a 32-bit index can name");
    if (mesh.normals.size() != vertices) return unequal("normals", mesh.normals.size(), vertices);
    if (!mesh.tangents.empty() && mesh.tangents.size() != vertices) {
        return unequal("tangents", mesh.tangents.size(), vertices);
    }
    for (const auto& [name, set] : uv_sets_of(mesh)) {
        if (!set.empty() && set.size() != vertices) return unequal(name, set.size(), vertices);
    }
    if (!mesh.colors.empty() && mesh.colors.size() != vertices) return unequal("colors", mesh.colors.size(), vertices);
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec4& t = mesh.triangles[i];
        const uint32_t largest = std::max(t.x, std::max(t.y, t.z));
        if (largest >= vertices) {
            return Status::invalid("mesh: triangle " + std::to_string(i) + " names vertex " + std::to_string(largest) +
                                   ", but there are " + std::to_string(vertices) + " vertices");
        }
    }
    return validate_values(mesh);
}

Status validate_transform(const CoreTransform& transform) {
    for (const glm::vec4& row : transform.rows) {
        if (!finite(row)) return Status::invalid("instance: the matrix is not finite");
    }
    return Status::success();
}

Status validate_lights(const CoreLights& lights) {
    if (lights.lights.size() != lights.table.size()) {
        return Status::invalid("lights: " + std::to_string(lights.lights.size()) + " lights, but the table has " +
                               std::to_string(lights.table.size()) + " entries");
    }
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        const Status status = validate_light(lights.lights[i]);
        if (!status.ok()) return Status::invalid("light " + std::to_string(i) + ": " + status.message);
    }
    return validate_table(lights.table, "lights");
}

Status validate_sky(const CoreSky& sky) {
    const uint64_t wanted = static_cast<uint64_t>(sky.width) * sky.height;
    const std::string size = std::to_string(sky.width) + "x" + std::to_string(sky.height);
    if (sky.texels.size() != wanted) {
        return Status::invalid("sky: " + std::to_string(sky.texels.size()) + " texels for a map of " + size);
    }
    if (sky.table.size() != wanted) {
        return Status::invalid("sky: " + std::to_string(sky.table.size()) + " table entries for a map of " + size);
    }
    return validate_table(sky.table, "sky");
}

Status CoreContract::check_open(const char* call) const {
    if (stage_ == Stage::open) return Status::success();
    return Status::error(StatusCode::wrong_order,
                         std::string(call) + (stage_ == Stage::created ? " came before Init" : " came after Shutdown"));
}

Status CoreContract::check_init() const {
    if (stage_ == Stage::created) return Status::success();
    return Status::error(StatusCode::wrong_order,
                         stage_ == Stage::open ? "Init came a second time" : "Init came after Shutdown");
}

Status CoreContract::check_target(const CoreTarget& target) const {
    Status order = check_open("SetTarget");
    return order.ok() ? validate_target(target) : order;
}

Status CoreContract::check_settings(const CoreSettings& settings) const {
    Status order = check_open("Setting");
    return order.ok() ? validate_settings(settings) : order;
}

Status CoreContract::check_textures(std::span<const CoreTexture> textures) const {
    if (Status order = check_open("SetTextures"); !order.ok()) return order;
    for (size_t i = 0; i < textures.size(); ++i) {
        Status status = validate_texture(textures[i]);
        if (status.ok()) continue;
        status.message = "texture " + std::to_string(i) + ": " + status.message;
        return status;
    }
    return Status::success();
}

Status CoreContract::check_materials(uint32_t first, std::span<const CoreMaterial> materials) const {
    if (Status order = check_open("SetMaterials"); !order.ok()) return order;
    if (first > last_textures_.size()) {
        return Status::invalid("SetMaterials: starts at " + std::to_string(first) + ", which leaves a gap after the " +
                               std::to_string(last_textures_.size()) + " materials there are");
    }
    if (materials.size() >= NONE - first)
        return Status::invalid("SetMaterials: more materials than a 32-bit index can name");
    for (size_t i = 0; i < materials.size(); ++i) {
        if (Status status = check_material(materials[i]); !status.ok())
            return Status::invalid("SetMaterials: material " + std::to_string(first + i) + ": " + status.message);
    }
    return Status::success();
}

Status CoreContract::check_lights(const CoreLights& lights) const {
    Status order = check_open("SetLights");
    return order.ok() ? validate_lights(lights) : order;
}

Status CoreContract::check_sky(const CoreSky& sky) const {
    Status order = check_open("SetSkyData");
    return order.ok() ? validate_sky(sky) : order;
}

Status CoreContract::check_geometry(uint32_t mesh, const CoreMesh& data) const {
    if (Status order = check_open("SetGeometry"); !order.ok()) return order;
    if (mesh > meshes_.size()) {
        return Status::invalid("SetGeometry: mesh " + std::to_string(mesh) + " leaves a gap; the next free id is " +
                               std::to_string(meshes_.size()));
    }
    return validate_mesh(data);
}

Status CoreContract::check_instance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) const {
    if (Status order = check_open("SetInstance"); !order.ok()) return order;
    if (instance > instances_.size()) {
        return Status::invalid("SetInstance: instance " + std::to_string(instance) +
                               " leaves a gap; the next free id is " + std::to_string(instances_.size()));
    }
    if (mesh != NONE && mesh >= meshes_.size()) {
        return Status::invalid("SetInstance: mesh " + std::to_string(mesh) + " does not exist; there are " +
                               std::to_string(meshes_.size()));
    }
    return validate_transform(transform);
}

// Worked out once for all calls of Render between two edits.
const CoreContract::Extent& CoreContract::extent() const {
    if (extent_) return *extent_;
    extent_.emplace();
    for (size_t i = 0; i < instances_.size(); ++i) {
        const PlacedInstance& instance = instances_[i];
        if (instance.mesh == NONE) continue;
        const Placement placement = placement_of(meshes_[instance.mesh].box, instance.transform);
        if (placement.reach >= extent_->farthest.reach) {
            extent_->farthest = placement;
            extent_->farthest_instance = i;
        }
        if (placement.inverse >= extent_->smallest.inverse) extent_->smallest = placement;
        extent_->offset = std::max(extent_->offset, placement.offset);
    }
    return *extent_;
}

Status CoreContract::check_limits(const ViewPyramid& view) const {
    if (Status status = check_view(view); !status.ok()) return Status::invalid("Render: " + status.message);
    const Extent& all = extent();
    if (Status status = check_placement(all.farthest); !status.ok()) {
        return Status::invalid("Render: instance " + std::to_string(all.farthest_instance) + " " + status.message);
    }
    const double reach = std::max(largest_coordinate(view.eye), all.farthest.reach);
    if (check_rays_into(all.smallest, reach + all.offset).ok()) return Status::success();
    // Seldom reached: which of them it is.
    for (size_t i = 0; i < instances_.size(); ++i) {
        if (instances_[i].mesh == NONE) continue;
        const Placement placement = placement_of(meshes_[instances_[i].mesh].box, instances_[i].transform);
        const Status status = check_rays_into(placement, reach);
        if (!status.ok()) return Status::invalid("Render: instance " + std::to_string(i) + ": " + status.message);
    }
    return Status::success();
}

Status CoreContract::check_watch() const { return check_open("SetWatch"); }

Status CoreContract::check_history() const { return check_open("GetHistory"); }

Status CoreContract::check_filter(const ViewPyramid& view, const CoreFilter& filter, const CoreTarget& target) const {
    if (Status status = check_render(view, filter.samples); !status.ok()) return status;
    const size_t pixels = target.pixels.size();
    if (filter.means.size() != pixels || filter.filtered.size() != pixels)
        return Status::invalid("Filter: " + std::to_string(filter.means.size()) + " means into " +
                               std::to_string(filter.filtered.size()) + " pixels for a target of " +
                               std::to_string(pixels));
    if (filter.most_rays == 0) return Status::invalid("Filter: by 0 camera rays; ask for at least 1");
    if (!filter.variances.empty() && filter.variances.size() != pixels)
        return Status::invalid("Filter: " + std::to_string(filter.variances.size()) + " variances for " +
                               std::to_string(pixels) + " pixels");
    return Status::success();
}

Status CoreContract::check_render(const ViewPyramid& view, uint32_t samples) const {
    if (Status order = check_open("Render"); !order.ok()) return order;
    if (!has_target_) return Status::error(StatusCode::wrong_order, "Render came before SetTarget");
    if (samples == 0) return Status::invalid("Render: 0 samples; ask for at least 1");
    for (const PlacedInstance& instance : instances_) {
        if (instance.mesh == NONE) continue;
        const Mesh& mesh = meshes_[instance.mesh];
        if (mesh.triangles > 0 && mesh.last_material >= last_textures_.size()) {
            return Status::invalid("Render: mesh " + std::to_string(instance.mesh) + " uses material " +
                                   std::to_string(mesh.last_material) + ", but there are " +
                                   std::to_string(last_textures_.size()));
        }
    }
    for (size_t i = 0; i < last_textures_.size(); ++i) {
        if (last_textures_[i] > textures_) {
            return Status::invalid("Render: material " + std::to_string(i) + " uses texture " +
                                   std::to_string(last_textures_[i] - 1) + ", but there are " +
                                   std::to_string(textures_));
        }
    }
    if (lights_last_texture_ > textures_) {
        return Status::invalid("Render: a light uses texture " + std::to_string(lights_last_texture_ - 1) +
                               ", but there are " + std::to_string(textures_));
    }
    return check_limits(view);
}

void CoreContract::accept_init() { stage_ = Stage::open; }
void CoreContract::accept_target() { has_target_ = true; }
void CoreContract::accept_textures(std::span<const CoreTexture> textures) { textures_ = textures.size(); }
void CoreContract::accept_shutdown() { stage_ = Stage::closed; }

void CoreContract::accept_materials(uint32_t first, std::span<const CoreMaterial> materials) {
    last_textures_.resize(std::max(last_textures_.size(), first + materials.size()));
    std::transform(materials.begin(), materials.end(), last_textures_.begin() + first, last_texture);
}

void CoreContract::accept_lights(const CoreLights& lights) {
    lights_last_texture_ = 0;
    for (const CoreLight& light : lights.lights) {
        if (light.kind != LightKind::triangle || light.emission_texture.texture == NONE) continue;
        lights_last_texture_ = std::max(lights_last_texture_, light.emission_texture.texture + 1);
    }
}

void CoreContract::accept_geometry(uint32_t mesh, const CoreMesh& data) {
    if (mesh == meshes_.size()) meshes_.emplace_back();
    meshes_[mesh] = {data.triangles.size(), 0, {}};
    for (const glm::vec3& position : data.positions) meshes_[mesh].box.extend(position);
    extent_.reset();
    for (const glm::uvec4& triangle : data.triangles) {
        meshes_[mesh].last_material = std::max(meshes_[mesh].last_material, triangle.w);
    }
}

void CoreContract::accept_instance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) {
    if (instance == instances_.size()) instances_.emplace_back();
    instances_[instance] = {mesh, transform};
    extent_.reset();
}

uint64_t CoreContract::triangles() const {
    uint64_t sum = 0;
    for (const PlacedInstance& instance : instances_) {
        if (instance.mesh != NONE) sum += meshes_[instance.mesh].triangles;
    }
    return sum;
}

}  // namespace render_system

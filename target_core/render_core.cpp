// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/render_core.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <optional>
#include <thread>

#include "render_system/core_checks.h"
#include "render_system/scene_limits.h"
#include "target_core/core_mesh.h"
#include "target_core/core_tables.h"
#include "target_core/device/embree_scene.h"
#include "target_core/frame.h"

namespace target_core {

using namespace render_system;

namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

vec4 to_row(const glm::vec3& v, float w = 0.0f) { return vec4(v.x, v.y, v.z, w); }

class TargetCore final : public CoreAPI {
public:
    CoreStats GetCoreStats() const override;
    Status Init(const CoreOptions& options) override;
    Status SetTarget(const CoreTarget& target) override;
    Status Setting(const CoreSettings& settings) override;
    Status SetTextures(std::span<const CoreTexture> textures) override;
    Status SetMaterials(uint32_t first, std::span<const CoreMaterial> materials) override;
    Status SetLights(const CoreLights& lights) override;
    Status SetSkyData(const CoreSky& sky) override;
    Status SetGeometry(uint32_t mesh, const CoreMesh& data) override;
    Status SetInstance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) override;
    Status Render(const ViewPyramid& view, Convergence convergence, uint32_t samples) override;
    void Shutdown() override;

private:
    /// A call that allocates, with bad_alloc turned into a status.
    template <class Work>
    Status guarded(Work&& work);
    Status prepare();
    void restart();
    Settings frame_settings(const ViewPyramid& view) const;
    Bindings bindings();
    /// The widest that this CPU runs; in exact mode the reference.
    const KernelTable& kernels() const { return options_.exact ? one_lane_kernels : *runnable_kernels().tables[0]; }
    void measure_limit(const RayLog& log);
    uint64_t memory_bytes() const;

    CoreContract contract_;
    CoreOptions options_;
    Workers workers_;
    CoreTarget target_;
    CoreSettings settings_;
    CoreStats stats_;
    std::vector<CoreMaterial> materials_;
    SceneTables tables_;
    std::vector<float> opacities_;
    CoreMeshes meshes_;
    EmbreeScene embree_;
    std::optional<tbb::global_control> parallelism_;
    std::optional<tbb::task_arena> arena_;
    std::vector<vec4> accumulator_;  // sums of all samples
    float total_light_weight_ = 0.0f;
    uint light_features_ = 0;
    glm::vec3 sky_radiance_{0.0f};
    uint32_t sky_width_ = 0;
    uint32_t sky_height_ = 0;
    float sky_light_probability_ = 0.0f;
    uint features_ = 0;
    bool geometry_dirty_ = true;
    bool materials_dirty_ = true;
};

CoreStats TargetCore::GetCoreStats() const {
    CoreStats stats = stats_;
    stats.memory_bytes = memory_bytes();
    stats.trace_build_ms = embree_.build_ms();
    stats.trace_memory_bytes = embree_.memory_bytes() + meshes_.traced_bytes();
    stats.texel_bytes = tables_.texels.size() * sizeof(tables_.texels[0]);
    return stats;
}

Status TargetCore::Init(const CoreOptions& options) {
    if (Status status = contract_.check_init(); !status.ok()) {
        return status;
    }
    uint32_t hardware = std::max(1u, std::thread::hardware_concurrency());
    options_ = options;
    options_.threads = options.threads > 0 ? options.threads : hardware;
    parallelism_.emplace(tbb::global_control::max_allowed_parallelism, std::max(hardware, options_.threads));
    arena_.emplace(static_cast<int>(options_.threads));
    std::string message;
    bool opened = false;
    // Inside the arena: elsewhere Embree limits TBB to the machine's threads, and TBB says so on stderr.
    arena_->execute([&] { opened = embree_.open(options_.threads, message); });
    if (!opened) {
        return Status::error(StatusCode::no_device, "target core: " + message);
    }
    stats_.core = "target";
    stats_.device = std::string("CPU, Embree " RTC_VERSION_STRING ", ") + kernels().name;
    stats_.threads = options_.threads;
    contract_.accept_init();
    return Status::success();
}

template <class Work>
Status TargetCore::guarded(Work&& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return Status::out_of_memory("target core: the machine's memory is used up", memory_bytes(), 0);
    }
}

Status TargetCore::SetTarget(const CoreTarget& target) {
    if (Status status = contract_.check_target(target); !status.ok()) {
        return status;
    }
    return guarded([&] {
        if (target.width != target_.width || target.height != target_.height) {
            accumulator_.assign(size_t{target.width} * target.height, vec4(0.0f));
            restart();
        }
        target_ = target;
        contract_.accept_target();
        return Status::success();
    });
}

Status TargetCore::Setting(const CoreSettings& settings) {
    if (Status status = contract_.check_settings(settings); !status.ok()) {
        return status;
    }
    settings_ = settings;
    return Status::success();
}

Status TargetCore::SetTextures(std::span<const CoreTexture> textures) {
    if (Status status = contract_.check_textures(textures); !status.ok()) {
        return status;
    }
    return guarded([&] {
        pack_textures(textures, tables_);
        contract_.accept_textures(textures);
        return Status::success();
    });
}

Status TargetCore::SetMaterials(uint32_t first, std::span<const CoreMaterial> materials) {
    if (Status status = contract_.check_materials(first, materials); !status.ok()) {
        return status;
    }
    return guarded([&] {
        materials_.resize(std::max(materials_.size(), first + materials.size()));
        std::copy(materials.begin(), materials.end(), materials_.begin() + first);
        materials_dirty_ = true;
        contract_.accept_materials(first, materials);
        return Status::success();
    });
}

Status TargetCore::SetLights(const CoreLights& lights) {
    if (Status status = contract_.check_lights(lights); !status.ok()) {
        return status;
    }
    return guarded([&] {
        pack_lights(lights, tables_);
        total_light_weight_ = lights.total_weight;
        light_features_ = light_features(lights);
        contract_.accept_lights(lights);
        return Status::success();
    });
}

Status TargetCore::SetSkyData(const CoreSky& sky) {
    if (Status status = contract_.check_sky(sky); !status.ok()) {
        return status;
    }
    return guarded([&] {
        pack_sky(sky, tables_);
        sky_radiance_ = sky.radiance;
        sky_width_ = sky.width;
        sky_height_ = sky.height;
        sky_light_probability_ = sky.light_probability;
        return Status::success();
    });
}

Status TargetCore::SetGeometry(uint32_t mesh, const CoreMesh& data) {
    if (Status status = contract_.check_geometry(mesh, data); !status.ok()) {
        return status;
    }
    return guarded([&] {
        meshes_.set_mesh(mesh, data);
        geometry_dirty_ = true;
        contract_.accept_geometry(mesh, data);
        return Status::success();
    });
}

Status TargetCore::SetInstance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) {
    if (Status status = contract_.check_instance(instance, mesh, transform); !status.ok()) {
        return status;
    }
    if (mesh != NONE && !is_invertible(transform)) {  // Embree takes rays into the mesh's space
        return Status::error(StatusCode::invalid_argument, "instance: the matrix cannot be inverted");
    }
    return guarded([&] {
        meshes_.set_instance(instance, mesh, transform);
        geometry_dirty_ = true;
        contract_.accept_instance(instance, mesh, transform);
        return Status::success();
    });
}

// Builds what changed since the last Render.
Status TargetCore::prepare() {
    if (materials_dirty_) {
        pack_materials(materials_, tables_);
        geometry_dirty_ = geometry_dirty_ || meshes_.passing_changed(materials_);
    }
    if (geometry_dirty_) {
        auto start = std::chrono::steady_clock::now();
        meshes_.place(materials_);
        std::string message;
        bool built = false;
        arena_->execute([&] { built = embree_.build(meshes_.geometry(), options_.exact, message); });
        if (!built) {
            return Status::out_of_memory("target core: " + message, memory_bytes(), 0);
        }
        stats_.build_ms = milliseconds_since(start);
        stats_.triangles = contract_.triangles();
    }
    if (materials_dirty_ || geometry_dirty_) {
        opacities_.clear();
        for (const CoreMaterial& material : materials_) {
            opacities_.push_back(opacity_code(material, meshes_.has_colors()));
        }
    }
    geometry_dirty_ = false;
    materials_dirty_ = false;
    features_ = material_features(materials_) | light_features_ | meshes_.features(materials_) |
                (sky_width_ > 0 ? FEATURE_SKY_MAP : 0u);
    return Status::success();
}

void TargetCore::restart() {
    CoreStats fresh;
    fresh.core = stats_.core;
    fresh.device = stats_.device;
    fresh.threads = stats_.threads;
    fresh.triangles = stats_.triangles;
    fresh.build_ms = stats_.build_ms;
    stats_ = fresh;
}

Settings TargetCore::frame_settings(const ViewPyramid& view) const {
    glm::vec3 corner = view.top_left - view.eye;
    glm::vec3 right = view.top_right - view.top_left;
    glm::vec3 down = view.bottom_left - view.top_left;
    float distance = glm::length(corner + 0.5f * (right + down));
    float pixel_angle = glm::length(down) / (static_cast<float>(target_.height) * std::max(distance, 1.0e-30f));
    Settings settings{};
    settings.eye = to_row(view.eye, pixel_angle);
    settings.screen = to_row(corner);
    settings.screen_right = to_row(right);
    settings.screen_down = to_row(down);
    settings.sky_radiance = to_row(sky_radiance_);
    settings.scene_extent = vec4(0.0f);
    settings.width = target_.width;
    settings.height = target_.height;
    settings.seed = settings_.seed;
    settings.max_path_length = settings_.max_path_length;
    settings.russian_roulette = settings_.russian_roulette ? 1u : 0u;
    settings.next_event_estimation = settings_.next_event_estimation ? 1u : 0u;
    settings.light_count = static_cast<uint>(tables_.light_table.size());
    settings.features = features_;
    settings.sky_width = sky_width_;
    settings.sky_height = sky_height_;
    settings.sky_light_probability = sky_light_probability_;
    settings.light_weight_scale = total_light_weight_ > 0.0f ? 1.0f / total_light_weight_ : 0.0f;
    return settings;
}

Bindings TargetCore::bindings() {
    Bindings bindings;
    bindings.mesh_triangles = meshes_.mesh_triangles().data();
    bindings.vertices = meshes_.vertices().data();
    bindings.tangents = meshes_.tangents().data();
    bindings.instances = meshes_.instances().data();
    bindings.materials = tables_.materials.data();
    bindings.texture_slots = tables_.texture_slots.data();
    bindings.textures = tables_.textures.data();
    bindings.texels = tables_.texels.data();
    bindings.lights = tables_.lights.data();
    bindings.light_table = tables_.light_table.data();
    bindings.sky_texels = tables_.sky_texels.data();
    bindings.sky_table = tables_.sky_table.data();
    bindings.opacities = opacities_.data();
    bindings.geometry = meshes_.geometry().data();
    bindings.scene = embree_.scene();
    bindings.accumulator = accumulator_.data();
    return bindings;
}

void TargetCore::measure_limit(const RayLog& log) {
    arena_->execute([&] { stats_.trace_limit_ms += log.replay(embree_.device(), embree_.scene()); });
    stats_.trace_limit_rays += log.count();
}

Status TargetCore::Render(const ViewPyramid& view, Convergence convergence, uint32_t samples) {
    if (Status status = contract_.check_render(view, samples); !status.ok()) {
        return status;
    }
    return guarded([&] {
        if (Status status = prepare(); !status.ok()) {
            return status;
        }
        if (convergence == Convergence::Restart) {
            restart();
        }
        auto start = std::chrono::steady_clock::now();
        std::optional<RayLog> log;
        if (settings_.measure_trace_limit && !options_.exact) {
            log.emplace();
        }
        Frame frame;
        frame.kernels = &kernels();
        frame.bindings = bindings();
        frame.settings = frame_settings(view);
        frame.samples_in_sum = static_cast<uint>(stats_.samples);
        frame.first_sample = settings_.first_sample + frame.samples_in_sum;
        frame.sample_count = samples;
        frame.pixels = target_.pixels;
        FrameStats rendered;
        arena_->execute([&] { rendered = render_frame(frame, workers_, log ? &*log : nullptr); });
        double threads = stats_.threads;
        stats_.samples += samples;
        stats_.primary_rays += rendered.primary_rays;
        stats_.extension_rays += rendered.extension_rays;
        stats_.shadow_rays += rendered.shadow_rays;
        stats_.generate_ms += rendered.generate_ms / threads;
        stats_.extend_ms += rendered.extend_ms / threads;
        stats_.shade_ms += rendered.shade_ms / threads;
        stats_.connect_ms += rendered.connect_ms / threads;
        stats_.finalize_ms += rendered.finalize_ms / threads;
        stats_.total_ms += milliseconds_since(start);
        if (log) {
            measure_limit(*log);
        }
        return Status::success();
    });
}

uint64_t TargetCore::memory_bytes() const {
    auto bytes = [](const auto& rows) { return rows.capacity() * sizeof(rows[0]); };
    return meshes_.memory_bytes() + embree_.memory_bytes() + bytes(accumulator_) + bytes(tables_.materials) +
           bytes(tables_.texture_slots) + bytes(tables_.textures) + bytes(tables_.texels) + bytes(tables_.lights) +
           bytes(tables_.light_table) + bytes(tables_.sky_texels) + bytes(tables_.sky_table);
}

void TargetCore::Shutdown() {
    contract_.accept_shutdown();
    embree_.close();
    meshes_ = {};
    tables_ = {};
    accumulator_ = {};
    workers_.clear();
    arena_.reset();
    parallelism_.reset();
}

}  // namespace

std::unique_ptr<CoreAPI> create_core() { return std::make_unique<TargetCore>(); }

}  // namespace target_core

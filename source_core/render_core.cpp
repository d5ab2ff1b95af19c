// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/render_core.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <new>
#include <optional>
#include <thread>

#include "render_system/core_checks.h"
#include "source_core/core_tuning.h"
#include "source_core/device/kernel_files.h"
#include "source_core/scene_store.h"
#include "source_core/wavefront.h"

namespace source_core {

using namespace render_system;

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

constexpr uint32_t SMALLEST_BATCH = 1u << 14;  // below, dispatches cost more than they do

// Everything that lives on the device, in the order of creation.
struct Gpu {
    std::optional<Instance> instance;
    std::optional<Device> device;
    std::optional<MemoryBudget> budget;
    std::optional<Staging> staging;
    SceneBuffers scene;
    std::optional<Wavefront> wavefront;
    std::map<std::string, KernelSet> kernels;  // by preamble
};

class SourceCore final : public CoreAPI {
public:
    explicit SourceCore(const CoreTuning& tuning) : tuning_(tuning) {}

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
    template <class Work>
    Status guarded(Work&& work);
    Status open_device(const CoreOptions& options);
    Status prepare();
    Status check_budget(uint64_t table_bytes);
    Status choose_table_access();
    Status upload();
    Status size_wavefront();
    Result<const KernelSet*> find_kernels();
    Status render_batches(const KernelSet& kernels, const Settings& settings, uint32_t samples);
    Settings frame_settings(const ViewPyramid& view) const;
    WavefrontSize wavefront_size(uint64_t table_bytes) const;
    uint64_t all_table_bytes() const;
    void restart();

    CoreTuning tuning_;
    CoreContract contract_;
    CoreOptions options_;
    CoreTarget target_;
    CoreSettings settings_;
    CoreStats stats_;
    SceneStore scene_;
    std::map<std::string, std::string> kernel_files_;
    KernelVariant variant_;
    std::unique_ptr<Gpu> gpu_;
};

// A call that allocates, with bad_alloc turned into a status.
template <class Work>
Status SourceCore::guarded(Work&& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return Status::out_of_memory("source core: the machine's memory is used up", stats_.memory_bytes, 0);
    }
}

CoreStats SourceCore::GetCoreStats() const {
    CoreStats stats = stats_;
    if (gpu_) {
        stats.memory_bytes = gpu_->budget->used();
        stats.memory_allowed_bytes = gpu_->budget->limit();
        stats.texel_bytes = scene_.rows(BINDING_TEXELS).size();
    }
    return stats;
}

Status SourceCore::Init(const CoreOptions& options) {
    if (Status status = contract_.check_init(); !status.ok()) {
        return status;
    }
    return guarded([&] {
        Result<std::map<std::string, std::string>> files = read_kernel_files(options.kernels_directory);
        if (!files.ok()) {
            return files.status;
        }
        kernel_files_ = std::move(*files);
        Status status = open_device(options);
        if (!status.ok()) {
            gpu_.reset();
            return status;
        }
        options_ = options;
        stats_.core = "source";
        stats_.device = gpu_->device->name();
        stats_.threads = options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
        contract_.accept_init();
        return Status::success();
    });
}

Status SourceCore::open_device(const CoreOptions& options) {
    gpu_ = std::make_unique<Gpu>();
    const Validation checks = tuning_.assisted_validation ? Validation::assisted : Validation::host;
    Result<Instance> instance = Instance::create(options.validate ? checks : Validation::none);
    if (!instance.ok()) {
        return instance.status;
    }
    gpu_->instance.emplace(std::move(*instance));
    Result<Device> device = Device::create(*gpu_->instance);
    if (!device.ok()) {
        return device.status;
    }
    gpu_->device.emplace(std::move(*device));
    const uint64_t heap = gpu_->device->limits().local_heap_size;
    gpu_->budget.emplace(options.memory_limit > 0 ? options.memory_limit : heap);
    return gpu_->instance->validation_status();
}

Status SourceCore::SetTarget(const CoreTarget& target) {
    if (Status status = contract_.check_target(target); !status.ok()) {
        return status;
    }
    if (target.width != target_.width || target.height != target_.height) {
        restart();
    }
    target_ = target;
    contract_.accept_target();
    return Status::success();
}

Status SourceCore::Setting(const CoreSettings& settings) {
    if (Status status = contract_.check_settings(settings); !status.ok()) {
        return status;
    }
    settings_ = settings;
    return Status::success();
}

Status SourceCore::SetTextures(std::span<const CoreTexture> textures) {
    if (Status status = contract_.check_textures(textures); !status.ok()) {
        return status;
    }
    return guarded([&] {
        scene_.set_textures(textures);
        contract_.accept_textures(textures);
        return Status::success();
    });
}

Status SourceCore::SetMaterials(uint32_t first, std::span<const CoreMaterial> materials) {
    if (Status status = contract_.check_materials(first, materials); !status.ok()) {
        return status;
    }
    return guarded([&] {
        scene_.set_materials(first, materials);
        contract_.accept_materials(first, materials);
        return Status::success();
    });
}

Status SourceCore::SetLights(const CoreLights& lights) {
    if (Status status = contract_.check_lights(lights); !status.ok()) {
        return status;
    }
    return guarded([&] {
        scene_.set_lights(lights);
        contract_.accept_lights(lights);
        return Status::success();
    });
}

Status SourceCore::SetSkyData(const CoreSky& sky) {
    if (Status status = contract_.check_sky(sky); !status.ok()) {
        return status;
    }
    return guarded([&] {
        scene_.set_sky(sky);
        return Status::success();
    });
}

Status SourceCore::SetGeometry(uint32_t mesh, const CoreMesh& data) {
    if (Status status = contract_.check_geometry(mesh, data); !status.ok()) {
        return status;
    }
    return guarded([&] {
        scene_.set_mesh(mesh, data);
        contract_.accept_geometry(mesh, data);
        return Status::success();
    });
}

Status SourceCore::SetInstance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) {
    if (Status status = contract_.check_instance(instance, mesh, transform); !status.ok()) {
        return status;
    }
    return guarded([&] {
        scene_.set_instance(instance, mesh, transform);
        contract_.accept_instance(instance, mesh, transform);
        return Status::success();
    });
}

uint64_t SourceCore::all_table_bytes() const {
    uint64_t sum = 0;
    for (uint32_t table = 0; table < TABLE_COUNT; ++table) {
        sum += table_bytes(scene_.bytes(table));
    }
    return sum;
}

// As many paths at once as there are pixels, up to the limit; fewer where that helps to fit the budget.
WavefrontSize SourceCore::wavefront_size(uint64_t table_bytes) const {
    const uint64_t pixels = uint64_t{target_.width} * target_.height;
    const uint64_t limits_batch =
        std::min<uint64_t>({tuning_.largest_batch, uint64_t{gpu_->device->limits().work_group_count} * WORK_GROUP_SIZE,
                            gpu_->device->limits().storage_buffer_range / 16});
    WavefrontSize size{pixels, static_cast<uint32_t>(std::min(pixels, limits_batch))};
    while (size.batch / 2 >= SMALLEST_BATCH &&
           table_bytes + Wavefront::bytes(size, settings_.max_path_length) + 2 * Staging::PIECE >
               gpu_->budget->limit()) {
        size.batch = (size.batch / 2 + 15) / 16 * 16;
    }
    return size;
}

Status SourceCore::check_budget(uint64_t table_bytes) {
    const uint64_t needed =
        table_bytes + 2 * Staging::PIECE + Wavefront::bytes(wavefront_size(table_bytes), settings_.max_path_length);
    if (needed > gpu_->budget->limit()) {
        return Status::out_of_memory("source core: the scene needs more device memory than allowed", needed,
                                     gpu_->budget->limit());
    }
    return Status::success();
}

Status SourceCore::choose_table_access() {
    variant_.features = scene_.features();
    for (uint32_t table = 0; table < TABLE_COUNT; ++table) {
        const Result<TableAccess> access = choose_access(gpu_->device->limits(), table, scene_.bytes(table));
        if (!access.ok()) {
            return access.status;
        }
        variant_.tables[table] = tuning_.table_access.value_or(*access);
    }
    return Status::success();
}

// Builds and uploads what changed since the last Render. Nothing is uploaded unless all of it fits.
Status SourceCore::prepare() {
    // What the tables hold at least tells early that there is no room; how much would do is told with the tree.
    Status status = check_budget(scene_.least_table_bytes());
    if (!status.ok()) {
        return check_budget(scene_.likely_table_bytes());
    }
    status = scene_.build(options_.threads);
    stats_.build_ms = scene_.build_ms();
    stats_.triangles = contract_.triangles();
    if (status.ok()) {
        status = check_budget(all_table_bytes());
    }
    if (status.ok()) {
        status = choose_table_access();
    }
    if (status.ok()) {
        status = upload();
    }
    if (status.ok()) {
        status = size_wavefront();
    }
    return status;
}

Status SourceCore::upload() {
    if (!gpu_->staging) {
        Result<Staging> staging = Staging::create(*gpu_->device, *gpu_->budget);
        if (!staging.ok()) {
            return staging.status;
        }
        gpu_->staging.emplace(std::move(*staging));
    }
    for (uint32_t table = 0; table < TABLE_COUNT; ++table) {
        if (scene_.changed(table) || !gpu_->scene.buffer(table)) {
            Status status = gpu_->scene.replace(*gpu_->device, *gpu_->budget, *gpu_->staging, table, scene_.rows(table),
                                                variant_.tables[table]);
            if (!status.ok()) {
                return status;
            }
        }
    }
    scene_.uploaded();
    return Status::success();
}

Status SourceCore::size_wavefront() {
    const WavefrontSize size = wavefront_size(all_table_bytes());
    if (!gpu_->wavefront || gpu_->wavefront->size() != size) {
        restart();  // the sums go with the buffers
        gpu_->wavefront.reset();
        Result<Wavefront> wavefront = Wavefront::create(*gpu_->device, *gpu_->budget, size);
        if (!wavefront.ok()) {
            return wavefront.status;
        }
        gpu_->wavefront.emplace(std::move(*wavefront));
    }
    return gpu_->wavefront->set_max_path_length(*gpu_->device, *gpu_->budget, settings_.max_path_length);
}

Result<const KernelSet*> SourceCore::find_kernels() {
    const std::string key = variant_.preamble();
    auto found = gpu_->kernels.find(key);
    if (found == gpu_->kernels.end()) {
        Result<KernelSet> made = KernelSet::create(*gpu_->device, kernel_files_, variant_);
        if (!made.ok()) {
            return made.status;
        }
        found = gpu_->kernels.emplace(key, std::move(*made)).first;
    }
    return &found->second;
}

void SourceCore::restart() {
    CoreStats fresh;
    fresh.core = stats_.core;
    fresh.device = stats_.device;
    fresh.threads = stats_.threads;
    fresh.triangles = stats_.triangles;
    fresh.build_ms = stats_.build_ms;
    stats_ = fresh;
}

Settings SourceCore::frame_settings(const ViewPyramid& view) const {
    const glm::vec3 corner = view.top_left - view.eye;
    const glm::vec3 right = view.top_right - view.top_left;
    const glm::vec3 down = view.bottom_left - view.top_left;
    const float distance = glm::length(corner + 0.5f * (right + down));
    const float pixel_angle = glm::length(down) / (static_cast<float>(target_.height) * std::max(distance, 1.0e-30f));
    Settings settings{};
    settings.eye = glm::vec4(view.eye, pixel_angle);
    settings.screen = glm::vec4(corner, 0.0f);
    settings.screen_right = glm::vec4(right, 0.0f);
    settings.screen_down = glm::vec4(down, 0.0f);
    settings.width = target_.width;
    settings.height = target_.height;
    settings.seed = settings_.seed;
    settings.max_path_length = settings_.max_path_length;
    settings.russian_roulette = settings_.russian_roulette ? 1u : 0u;
    settings.next_event_estimation = settings_.next_event_estimation ? 1u : 0u;
    scene_.describe(settings);
    return settings;
}

Status SourceCore::render_batches(const KernelSet& kernels, const Settings& settings, uint32_t samples) {
    const WavefrontSize& size = gpu_->wavefront->size();
    WavefrontCounts counts;
    for (uint64_t first = 0; first < size.pixels; first += size.batch) {
        BatchPass batch;
        batch.first_pixel = static_cast<uint32_t>(first);
        batch.path_count = static_cast<uint32_t>(std::min<uint64_t>(size.batch, size.pixels - first));
        batch.samples_before = static_cast<uint32_t>(stats_.samples);
        batch.first_sample = settings_.first_sample + batch.samples_before;
        batch.samples = samples;
        gpu_->wavefront->bind(*gpu_->device, kernels, variant_, gpu_->scene, settings, batch);
        Status status = gpu_->wavefront->run(*gpu_->device, kernels, batch, counts);
        if (status.ok()) {
            status = gpu_->staging->download(*gpu_->device, gpu_->wavefront->target(),
                                             std::as_writable_bytes(target_.pixels.subspan(first, batch.path_count)));
        }
        if (!status.ok()) {
            return status;
        }
    }
    stats_.samples += samples;
    stats_.primary_rays += counts.primary_rays;
    stats_.extension_rays += counts.extension_rays - counts.primary_rays;
    stats_.shadow_rays += counts.shadow_rays;
    const auto time_of = [&counts](Kernel kernel) { return counts.kernel_ms[static_cast<uint32_t>(kernel)]; };
    stats_.generate_ms += time_of(Kernel::generate) + time_of(Kernel::schedule);
    stats_.extend_ms += time_of(Kernel::extend);
    stats_.shade_ms += time_of(Kernel::shade);
    stats_.connect_ms += time_of(Kernel::connect);
    stats_.finalize_ms += time_of(Kernel::finalize);
    return Status::success();
}

Status SourceCore::Render(const ViewPyramid& view, Convergence convergence, uint32_t samples) {
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
        const Result<const KernelSet*> kernels = find_kernels();
        if (!kernels.ok()) {
            return kernels.status;
        }
        const Clock::time_point start = Clock::now();
        Status status = render_batches(**kernels, frame_settings(view), samples);
        stats_.total_ms += milliseconds_since(start);
        return status.ok() ? gpu_->instance->validation_status() : status;
    });
}

void SourceCore::Shutdown() {
    contract_.accept_shutdown();
    gpu_.reset();
    scene_ = {};
    target_ = {};
}

}  // namespace

std::unique_ptr<CoreAPI> create_tuned_core(const CoreTuning& tuning) { return std::make_unique<SourceCore>(tuning); }

std::unique_ptr<CoreAPI> create_core() { return create_tuned_core({}); }

}  // namespace source_core

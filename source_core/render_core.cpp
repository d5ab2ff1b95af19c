// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/render_core.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "render_system/camera.h"
#include "render_system/checked_core.h"
#include "render_system/hot_kernels.h"
#include "source_core/core_tuning.h"
#include "source_core/device/kernel_files.h"
#include "source_core/device/kernel_store.h"
#include "source_core/sample_adder.h"
#include "source_core/scene_store.h"
#include "source_core/wavefront.h"

namespace source_core {

using namespace render_system;

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

static_assert(MOTION_ROWS == kMotionRows);

constexpr uint32_t SMALLEST_BATCH = 1u << 14;  // below, dispatches cost more than they do

// How many camera rays a pixel a filter goes by: those of its samples, and more where they are few; yet more where a
// pixel shows several things.
constexpr uint32_t FEWEST_GUIDE_RAYS = 16;
constexpr uint32_t MOST_GUIDE_RAYS = 64;

uint32_t guide_rays(const CoreFilter& filter, uint32_t fewest) {
    return std::min(std::max(filter.samples, fewest), filter.most_rays);
}

// Everything that lives on the device, in the order of creation.
struct Gpu {
    std::optional<Instance> instance;
    std::optional<Device> device;
    std::optional<MemoryBudget> budget;
    std::optional<Staging> staging;
    SceneBuffers scene;
    std::optional<Wavefront> wavefront;
    std::optional<KernelStore> kernels;
    const KernelSet* kernels_in_use = nullptr;
};

class SourceCore final : public CheckedCore, public HotKernels {
public:
    SourceCore(const CoreTuning& tuning, const SourceOptions& options)
        : CheckedCore("source"), tuning_(tuning), source_options_(options) {}

    CoreStats GetCoreStats() const override;
    std::vector<KernelText> GetKernelTexts() const override;
    Result<RecompiledKernels> compile_again() override;

private:
    Result<std::string> open() override;
    void resize(uint32_t, uint32_t) override {}  // the wavefront follows in prepare
    void set_textures(std::span<const CoreTexture> textures) override { scene_.set_textures(textures); }
    void set_materials(uint32_t first, std::span<const CoreMaterial> materials) override {
        scene_.set_materials(first, materials);
    }
    void set_lights(const CoreLights& lights) override { scene_.set_lights(lights); }
    void set_sky(const CoreSky& sky) override { scene_.set_sky(sky); }
    void set_mesh(uint32_t mesh, const CoreMesh& data) override { scene_.set_mesh(mesh, data); }
    std::vector<glm::vec3> positions_before(uint32_t mesh, const CoreMesh& data) const override {
        return scene_.positions_before(mesh, data);
    }
    void set_instance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) override {
        scene_.set_instance(instance, mesh, transform);
    }
    Status prepare() override;
    Status render(const ViewPyramid& view, uint32_t samples, CallOff& call_off) override;
    Status filter(const ViewPyramid& view, const CoreFilter& filter, CallOff& call_off) override;
    Status read_history(std::vector<float>& planes) override;
    Status write_history(std::span<const float> planes) override;
    void close() override;
    uint64_t host_bytes() const override { return 0; }  // what it holds is on the device

    Status open_device();
    Status check_budget(uint64_t table_bytes);
    Status choose_variant();
    Status upload();
    Status size_wavefront();
    Status find_kernels();
    Status render_batches(const Settings& settings, uint32_t samples, CallOff& call_off);
    Status render_batch(const Settings& settings, const BatchPass& batch, std::span<glm::vec4> pixels,
                        CallOff& call_off, WavefrontCounts& counts);
    void bind_filter(const Settings& settings);
    Status gather_guides(const Settings& settings, BatchPass batch, CallOff& call_off);
    Status prepare_filter(const Settings& settings, const CoreFilter& filter, CallOff& call_off);
    Status sum_batch(const Settings& settings, BatchPass batch, CallOff& call_off, WavefrontCounts& counts);
    Status name_primitives();
    Settings frame_settings(const ViewPyramid& view) const;
    Settings filter_settings(const ViewPyramid& view) const;
    Status make_filter(const CoreFilter& filter);
    WavefrontSize wavefront_size(uint64_t table_bytes) const;
    uint64_t all_table_bytes() const;

    CoreTuning tuning_;
    SourceOptions source_options_;
    SceneStore scene_;
    KernelVariant variant_;
    std::unique_ptr<Gpu> gpu_;
    std::vector<uint32_t> primitives_;  // of each slot of the table of triangles; empty until somebody watches
};

CoreStats SourceCore::GetCoreStats() const {
    CoreStats result = stats();
    if (gpu_) {
        result.memory_bytes = gpu_->budget->used();
        result.memory_allowed_bytes = gpu_->budget->limit();
        result.texel_bytes = scene_.rows(BINDING_TEXELS).size();
    }
    return result;
}

std::vector<KernelText> SourceCore::GetKernelTexts() const {
    std::vector<KernelText> texts;
    if (!gpu_) {
        return texts;
    }
    for (auto& [name, text] : gpu_->kernels->texts_that_run()) {
        texts.push_back({"source_core/kernels/" + name, text});
    }
    return texts;
}

Result<RecompiledKernels> SourceCore::compile_again() {
    if (!gpu_) {
        return Status::error(StatusCode::wrong_order, "source core: there are no kernels before Init");
    }
    return gpu_->kernels->compile_again(*gpu_->device);
}

Result<std::string> SourceCore::open() {
    Result<std::map<std::string, std::string>> files = read_kernel_files(source_options_.kernels_directory);
    if (!files.ok()) {
        return files.status;
    }
    Status status = open_device();
    if (!status.ok()) {
        gpu_.reset();
        return status;
    }
    gpu_->kernels.emplace(source_options_.kernels_directory, std::move(*files));
    return gpu_->device->name();
}

Status SourceCore::open_device() {
    gpu_ = std::make_unique<Gpu>();
    const Validation checks = tuning_.assisted_validation ? Validation::assisted : Validation::host;
    Result<Instance> instance = Instance::create(source_options_.validate ? checks : Validation::none);
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
    gpu_->budget.emplace(source_options_.memory_limit > 0 ? source_options_.memory_limit : heap);
    return gpu_->instance->validation_status();
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
    const uint64_t pixels = uint64_t{target().width} * target().height;
    const uint64_t limits_batch =
        std::min<uint64_t>({tuning_.largest_batch, uint64_t{gpu_->device->limits().work_group_count} * WORK_GROUP_SIZE,
                            gpu_->device->limits().storage_buffer_range / 16});
    WavefrontSize size{pixels, static_cast<uint32_t>(std::min(pixels, limits_batch))};
    while (size.batch / 2 >= SMALLEST_BATCH &&
           table_bytes + Wavefront::bytes(size, settings().max_path_length) + 2 * Staging::PIECE >
               gpu_->budget->limit()) {
        size.batch = (size.batch / 2 + 15) / 16 * 16;
    }
    return size;
}

Status SourceCore::check_budget(uint64_t table_bytes) {
    const uint64_t needed =
        table_bytes + 2 * Staging::PIECE + Wavefront::bytes(wavefront_size(table_bytes), settings().max_path_length);
    if (needed > gpu_->budget->limit()) {
        return Status::out_of_memory("source core: the scene needs more device memory than allowed", needed,
                                     gpu_->budget->limit());
    }
    return Status::success();
}

Status SourceCore::choose_variant() {
    variant_.features = scene_.features();
    variant_.arithmetic = options().exact ? gpu_->device->limits().exact : ExactArithmetic{};
    variant_.arithmetic.spelled_out |= tuning_.spelled_out_arithmetic;
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
    status = scene_.build(options().threads);
    stats().build_ms = scene_.build_ms();
    if (status.ok()) {
        status = check_budget(all_table_bytes());
    }
    if (status.ok()) {
        status = choose_variant();
    }
    if (status.ok()) {
        status = upload();
    }
    if (status.ok()) {
        status = size_wavefront();
    }
    if (status.ok()) {
        status = find_kernels();
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
                                                scene_.bytes(table), variant_.tables[table]);
            if (!status.ok()) {
                return status;
            }
        }
    }
    if (scene_.changed(BINDING_TRIANGLES)) {
        primitives_.clear();
    }
    std::vector<Staging::Part> parts;
    for (const TablePatch& patch : scene_.patches()) {
        parts.push_back({&gpu_->scene.buffer(patch.table), patch.offset, scene_.bytes_of(patch)});
        if (patch.table == BINDING_TRIANGLES) {
            primitives_.clear();
        }
    }
    Status status = gpu_->staging->upload(*gpu_->device, parts);
    if (status.ok()) {
        scene_.uploaded();
    }
    return status;
}

// Reads back which triangle each slot of the table holds: the host keeps no copy.
Status SourceCore::name_primitives() {
    if (!primitives_.empty()) {
        return Status::success();
    }
    constexpr size_t WORDS = TRIANGLE_ROWS * 4;
    constexpr size_t PRIMITIVE = 7;  // the last word of a slot's second row
    std::vector<uint32_t> words(scene_.bytes(BINDING_TRIANGLES) / sizeof(uint32_t));
    Status status = gpu_->staging->download(*gpu_->device, gpu_->scene.buffer(BINDING_TRIANGLES),
                                            std::as_writable_bytes(std::span(words)));
    for (size_t word = PRIMITIVE; word < words.size(); word += WORDS) {
        primitives_.push_back(words[word]);
    }
    return status;
}

Status SourceCore::size_wavefront() {
    const WavefrontSize size = wavefront_size(all_table_bytes());
    if (!gpu_->wavefront || gpu_->wavefront->size() != size) {
        drop_samples();  // the sums go with the buffers
        forget_frames();
        gpu_->wavefront.reset();
        Result<Wavefront> wavefront = Wavefront::create(*gpu_->device, *gpu_->budget, size);
        if (!wavefront.ok()) {
            return wavefront.status;
        }
        gpu_->wavefront.emplace(std::move(*wavefront));
    }
    return gpu_->wavefront->set_max_path_length(*gpu_->device, *gpu_->budget, settings().max_path_length);
}

Status SourceCore::find_kernels() {
    const Result<KernelStore::Found> found = gpu_->kernels->find(*gpu_->device, variant_);
    if (!found.ok()) {
        return found.status;
    }
    if (found->renewed) {
        drop_samples();  // they were taken by other kernels
    }
    gpu_->kernels_in_use = found->kernels;
    return Status::success();
}

Settings SourceCore::frame_settings(const ViewPyramid& view) const {
    const Screen screen = screen_of(view, target().height);
    Settings frame{};
    frame.eye = glm::vec4(view.eye, screen.pixel_angle);
    frame.screen = glm::vec4(screen.corner, 0.0f);
    frame.screen_right = glm::vec4(screen.right, 0.0f);
    frame.screen_down = glm::vec4(screen.down, 0.0f);
    frame.lens_right = glm::vec4(screen.lens_right, view.aperture);
    frame.lens_down = glm::vec4(screen.lens_down, screen.parallel_pixel);
    frame.width = target().width;
    frame.height = target().height;
    frame.pixel_count = target().width * target().height;
    frame.seed = settings().seed;
    frame.max_path_length = settings().max_path_length;
    frame.russian_roulette = settings().russian_roulette ? 1u : 0u;
    frame.next_event_estimation = settings().next_event_estimation ? 1u : 0u;
    frame.indirect_limit = settings().indirect_limit;
    scene_.describe(frame);
    return frame;
}

Settings SourceCore::filter_settings(const ViewPyramid& view) const {
    Settings frame = frame_settings(view);
    const FrameBefore& before = frame_before();
    const Screen screen = screen_of(before.frame > 1 ? before.view : view, target().height);
    frame.frame = before.frame;
    frame.max_path_length = std::min(frame.max_path_length, GUIDE_SEGMENTS);
    frame.scene_extent.w = GUIDE_SHARP;
    frame.motion = before.is_same           ? STANDS_STILL
                   : before.motions.empty() ? VIEW_MOVES
                   : before.shapes_changed  ? VERTICES_MOVE
                                            : INSTANCES_MOVE;
    frame.eye_before =
        glm::vec4(before.frame > 1 ? before.view.eye : view.eye, screen.parallel_pixel > 0.0f ? 1.0f : 0.0f);
    frame.screen_before = glm::vec4(screen.corner, 0.0f);
    frame.screen_right_before = glm::vec4(screen.right, 0.0f);
    frame.screen_down_before = glm::vec4(screen.down, 0.0f);
    return frame;
}

// Runs a batch and reads the mean of what its accumulator holds into `pixels`.
Status SourceCore::render_batch(const Settings& frame, const BatchPass& batch, std::span<glm::vec4> pixels,
                                CallOff& call_off, WavefrontCounts& counts) {
    const KernelSet& kernels = *gpu_->kernels_in_use;
    gpu_->wavefront->bind(*gpu_->device, kernels, variant_, gpu_->scene, frame, batch);
    Status status = watch() ? gpu_->wavefront->run_watched(*gpu_->device, kernels, batch, *gpu_->staging, primitives_,
                                                           *watch(), counts)
                            : gpu_->wavefront->run(*gpu_->device, kernels, batch, call_off, counts);
    if (!status.ok()) {
        return status;
    }
    return gpu_->staging->download(*gpu_->device, gpu_->wavefront->target(), std::as_writable_bytes(pixels));
}

// The same sample by sample, each added to the sums while the next one is taken.
Status SourceCore::sum_batch(const Settings& frame, BatchPass batch, CallOff& call_off, WavefrontCounts& counts) {
    const uint32_t samples = std::exchange(batch.samples, 1);
    const uint32_t place = batch.first_pixel - target().first_pixel;
    SampleAdder adder(target().sums.subspan(place, batch.path_count),
                      part_of_squares(target().squares, place, batch.path_count),
                      target().pixels.subspan(batch.first_pixel, batch.path_count), options().threads);
    batch.samples_before = 0;
    for (uint32_t i = 0; i < samples; ++i, ++batch.first_sample) {
        Status status = render_batch(frame, batch, adder.room(), call_off, counts);
        if (!status.ok()) {
            return status;
        }
        adder.add();
    }
    return Status::success();
}

Status SourceCore::render_batches(const Settings& frame, uint32_t samples, CallOff& call_off) {
    const WavefrontSize& size = gpu_->wavefront->size();
    const bool sums = !target().sums.empty();
    const uint64_t end = sums ? target().first_pixel + target().sums.size() : size.pixels;
    WavefrontCounts counts;
    for (uint64_t first = sums ? target().first_pixel : 0; first < end; first += size.batch) {
        BatchPass batch;
        batch.first_pixel = static_cast<uint32_t>(first);
        batch.path_count = static_cast<uint32_t>(std::min<uint64_t>(size.batch, end - first));
        batch.samples_before = static_cast<uint32_t>(stats().samples);
        batch.first_sample = settings().first_sample + batch.samples_before;
        batch.samples = samples;
        const std::span<glm::vec4> pixels = target().pixels.subspan(batch.first_pixel, batch.path_count);
        Status status =
            sums ? sum_batch(frame, batch, call_off, counts) : render_batch(frame, batch, pixels, call_off, counts);
        if (!status.ok()) {
            return status;
        }
    }
    stats().primary_rays += counts.primary_rays;
    stats().extension_rays += counts.extension_rays - counts.primary_rays;
    stats().shadow_rays += counts.shadow_rays;
    const auto time_of = [&counts](Kernel kernel) { return counts.kernel_ms[static_cast<uint32_t>(kernel)]; };
    stats().generate_ms += time_of(Kernel::generate) + time_of(Kernel::schedule);
    stats().extend_ms += time_of(Kernel::extend);
    stats().shade_ms += time_of(Kernel::shade);
    stats().connect_ms += time_of(Kernel::connect);
    stats().finalize_ms += time_of(Kernel::finalize);
    return Status::success();
}

Status SourceCore::render(const ViewPyramid& view, uint32_t samples, CallOff& call_off) {
    const Clock::time_point start = Clock::now();
    Status status = watch() ? name_primitives() : Status::success();
    if (status.ok()) {
        status = render_batches(frame_settings(view), samples, call_off);
    }
    stats().total_ms += milliseconds_since(start);
    return status.ok() ? gpu_->instance->validation_status() : status;
}

// The camera rays of these samples, as far as pixels want them, whose guides are added to those there are.
Status SourceCore::gather_guides(const Settings& frame, BatchPass batch, CallOff& call_off) {
    const WavefrontSize& size = gpu_->wavefront->size();
    Status status = Status::success();
    WavefrontCounts counts;
    for (uint64_t first = 0; first < size.pixels && status.ok(); first += size.batch) {
        batch.first_pixel = static_cast<uint32_t>(first);
        batch.path_count = static_cast<uint32_t>(std::min<uint64_t>(size.batch, size.pixels - first));
        gpu_->wavefront->bind(*gpu_->device, *gpu_->kernels_in_use, variant_, gpu_->scene, frame, batch);
        status = gpu_->wavefront->gather_guides(*gpu_->device, *gpu_->kernels_in_use, batch, call_off, counts);
    }
    return status;
}

void SourceCore::bind_filter(const Settings& frame) {
    BatchPass batch;
    batch.path_count = gpu_->wavefront->size().batch;
    batch.use = BatchUse::filter;
    gpu_->wavefront->bind(*gpu_->device, *gpu_->kernels_in_use, variant_, gpu_->scene, frame, batch);
}

// From the picture, which is on the device, to light by albedo, and guides of as many camera rays as a filter takes.
Status SourceCore::prepare_filter(const Settings& frame, const CoreFilter& filter, CallOff& call_off) {
    const uint32_t rays = guide_rays(filter, MOST_GUIDE_RAYS);
    WavefrontCounts counts;
    BatchPass batch;
    batch.first_sample = filter.first_sample;
    batch.samples = std::min(filter.samples, filter.most_rays);
    batch.use = BatchUse::guides;
    batch.rays_of_all = guide_rays(filter, FEWEST_GUIDE_RAYS);
    batch.segments = frame.max_path_length;
    Status status = gpu_->wavefront->clear_guides(*gpu_->device);
    if (status.ok()) {
        status = gather_guides(frame, batch, call_off);
    }
    if (status.ok()) {
        bind_filter(frame);
        status = gpu_->wavefront->divide_by_albedo(*gpu_->device, *gpu_->kernels_in_use, batch.samples, counts);
    }
    if (status.ok() && rays > batch.samples) {
        batch.first_sample += batch.samples;
        batch.samples = rays - batch.samples;
        status = gather_guides(frame, batch, call_off);
    }
    bind_filter(frame);
    return status.ok() ? call_off.status() : status;
}

// Buffers with the picture in place, and what moved.
Status SourceCore::make_filter(const CoreFilter& filter) {
    const bool with_history = filter.history != FilterHistory::none;
    const std::vector<glm::vec4>& motions = frame_before().motions;
    Status status = gpu_->wavefront->make_filter(*gpu_->device, *gpu_->budget, with_history, motions.size());
    if (status.ok() && with_history) {
        status = gpu_->wavefront->turn_history(*gpu_->device, frame_before().frame == 1);
    }
    if (!status.ok()) {
        return status;
    }
    std::vector<glm::vec4> picture(filter.means.begin(), filter.means.end());
    for (size_t pixel = 0; pixel < picture.size(); ++pixel) {
        const float variance = filter.variances.empty() ? -1.0f : filter.variances[pixel];
        picture[pixel] =
            filter.knows(pixel) ? glm::vec4(glm::vec3(picture[pixel]), variance) : glm::vec4(0.0f, 0.0f, 0.0f, NO_MEAN);
    }
    picture.insert(picture.end(), motions.begin(), motions.end());
    const Staging::Part part{&gpu_->wavefront->filter_picture(), 0, std::as_bytes(std::span(picture))};
    return gpu_->staging->upload(*gpu_->device, {&part, 1});
}

Status SourceCore::filter(const ViewPyramid& view, const CoreFilter& filter, CallOff& call_off) {
    const bool with_history = filter.history != FilterHistory::none;
    Status status = gpu_->kernels->add_filter(*gpu_->device, with_history);
    const Clock::time_point start = Clock::now();
    if (status.ok()) {
        status = make_filter(filter);
    }
    const Clock::time_point made = Clock::now();
    if (status.ok()) {
        status = prepare_filter(filter_settings(view), filter, call_off);
    }
    if (status.code == StatusCode::called_off && with_history) {
        const Status turned =
            gpu_->wavefront->turn_history(*gpu_->device, false);  // as it was: nothing was written yet
        return turned.ok() ? status : turned;
    }
    stats().guide_ms = milliseconds_since(made);
    WavefrontCounts counts;
    if (status.ok()) {
        status =
            gpu_->wavefront->run_filter(*gpu_->device, *gpu_->kernels_in_use, filter.samples, with_history, counts);
    }
    if (status.ok()) {
        status = gpu_->staging->download(*gpu_->device, gpu_->wavefront->filter_picture(),
                                         std::as_writable_bytes(filter.filtered));
    }
    stats().filter_ms = milliseconds_since(start) - stats().guide_ms;
    return status.ok() ? gpu_->instance->validation_status() : status;
}

Status SourceCore::read_history(std::vector<float>& planes) {
    planes.resize(target().pixels.size() * HISTORY_PLANES);
    return gpu_->staging->download(*gpu_->device, gpu_->wavefront->history(),
                                   std::as_writable_bytes(std::span(planes)));
}

Status SourceCore::write_history(std::span<const float> planes) {
    if (planes.size() != target().pixels.size() * HISTORY_PLANES) {
        return Status::invalid("source core: the history is of another size or core");
    }
    Status status = gpu_->wavefront->make_filter(*gpu_->device, *gpu_->budget, true, 0);
    if (!status.ok()) {
        return status;
    }
    const Staging::Part part{&gpu_->wavefront->history(), 0, std::as_bytes(planes)};
    return gpu_->staging->upload(*gpu_->device, {&part, 1});
}

void SourceCore::close() {
    gpu_.reset();
    primitives_ = {};
    scene_ = {};
}

}  // namespace

std::unique_ptr<CoreAPI> create_tuned_core(const CoreTuning& tuning, const SourceOptions& options) {
    return std::make_unique<SourceCore>(tuning, options);
}

bool has_software_device() {
    const Result<Instance> instance = Instance::create(Validation::none);
    return instance.ok() && Device::only_software(*instance);
}

std::unique_ptr<CoreAPI> create_core(const SourceOptions& options) { return create_tuned_core({}, options); }

}  // namespace source_core

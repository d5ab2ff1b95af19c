// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/render_core.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <thread>

#include "render_system/camera.h"
#include "render_system/checked_core.h"
#include "render_system/embree_probe.h"
#include "render_system/give_back.h"
#include "target_core/core_mesh.h"
#include "target_core/core_tables.h"
#include "target_core/device/embree_scene.h"
#include "target_core/device/kernel_texts.h"
#include "target_core/device/parallel.h"
#include "target_core/device/untouched_rows.h"
#include "target_core/frame.h"

namespace target_core {

using namespace render_system;

namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// How many camera rays a pixel a filter goes by: those of its samples, and more where they are few; yet more where a
// pixel shows several things.
constexpr uint FEWEST_GUIDE_RAYS = 16;
constexpr uint MOST_GUIDE_RAYS = 64;

uint guide_rays(const CoreFilter& filter, uint fewest) {
    return std::min(std::max(filter.samples, fewest), filter.most_rays);
}

// Rows of a pixel.
uint guide_rows(const CoreFilter& filter) {
    return filter.history == FilterHistory::none ? GUIDE_ROWS : GUIDE_ROWS + GUIDE_MOTION_ROWS;
}

static_assert(MOTION_ROWS == kMotionRows);

vec4 to_row(const glm::vec3& v, float w = 0.0f) { return vec4(v.x, v.y, v.z, w); }

class TargetCore final : public CheckedCore, public EmbreeProbe {
public:
    TargetCore() : CheckedCore("target", InstanceMatrices::invertible) {}

    CoreStats GetCoreStats() const override;
    std::vector<KernelText> GetKernelTexts() const override { return kernel_texts(); }
    EmbreeFigures embree_figures() const override;
    void measure_embree_limit(bool on) override { measures_limit_ = on; }

private:
    Result<std::string> open() override;
    void resize(uint32_t width, uint32_t height) override { accumulator_.assign(size_t{width} * height, vec4(0.0f)); }
    void set_textures(std::span<const CoreTexture> textures) override { pack_textures(textures, tables_); }
    void set_materials(uint32_t first, std::span<const CoreMaterial> materials) override;
    void set_lights(const CoreLights& lights) override;
    void set_sky(const CoreSky& sky) override;
    void set_mesh(uint32_t mesh, const CoreMesh& data) override;
    std::vector<glm::vec3> positions_before(uint32_t mesh, const CoreMesh& data) const override {
        return meshes_.positions_before(mesh, data);
    }
    void set_instance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) override;
    Status prepare() override;
    Status reach_for(const ViewPyramid& view);
    Status render(const ViewPyramid& view, uint32_t samples, CallOff& call_off) override;
    Status filter(const ViewPyramid& view, const CoreFilter& filter, CallOff& call_off) override;
    Status read_history(std::vector<float>& planes) override;
    Status write_history(std::span<const float> planes) override;
    void close() override;
    uint64_t host_bytes() const override;

    Settings frame_settings(const ViewPyramid& view) const;
    Settings filter_settings(const ViewPyramid& view) const;
    void pack_coincident_rows();
    void make_filter(const CoreFilter& filter);
    void hand_over(std::span<glm::vec4> filtered);
    Frame frame_of(const ViewPyramid& view);
    void gather_guides(Frame& frame, uint first_sample, uint samples);
    Bindings bindings();
    /// The widest that this CPU runs; in exact mode the reference.
    const KernelTable& kernels() const { return options().exact ? one_lane_kernels : *runnable_kernels().tables[0]; }

    Workers workers_;
    std::vector<CoreMaterial> materials_;
    SceneTables tables_;
    std::vector<float> opacities_;
    CoreMeshes meshes_;
    EmbreeScene embree_;
    CoincidentSurfaces coincident_;
    std::vector<uvec4> coincident_rows_;
    std::optional<tbb::global_control> parallelism_;
    std::optional<tbb::task_arena> arena_;
    std::vector<vec4> accumulator_;  // sums of all samples
    UntouchedRows<float> guides_;    // these three: none until a filter is asked for
    UntouchedRows<vec4> filter_picture_;
    UntouchedRows<float> planes_;
    std::span<std::byte> untouched_picture_;  // of these, what is new for the filter at work
    std::span<std::byte> untouched_planes_;
    size_t plane_margin_ = 0;    // of zeros before and behind each plane
    std::vector<vec4> motions_;  // and these: none until one has a history
    std::vector<float> history_;
    std::vector<float> history_before_;
    float total_light_weight_ = 0.0f;
    uint light_features_ = 0;
    glm::vec3 sky_radiance_{0.0f};
    uint32_t sky_width_ = 0;
    uint32_t sky_height_ = 0;
    float sky_light_probability_ = 0.0f;
    uint features_ = 0;
    float ray_reach_ = 0.0f;  // exact mode: the largest coordinate of an eye so far
    bool geometry_dirty_ = true;
    bool materials_dirty_ = true;
    bool measures_limit_ = false;
    double limit_ms_ = 0.0;  // of the last Render
    uint64_t limit_rays_ = 0;
};

CoreStats TargetCore::GetCoreStats() const {
    CoreStats result = stats();
    result.memory_bytes = host_bytes();
    result.texel_bytes = tables_.texels.size() * sizeof(tables_.texels[0]);
    return result;
}

EmbreeFigures TargetCore::embree_figures() const {
    return {embree_.build_ms(), embree_.memory_bytes() + meshes_.traced_bytes(), limit_ms_, limit_rays_};
}

Result<std::string> TargetCore::open() {
    uint32_t threads = options().threads;
    uint32_t most = std::max(std::thread::hardware_concurrency(), threads);
    parallelism_.emplace(tbb::global_control::max_allowed_parallelism, most);
    arena_.emplace(static_cast<int>(threads));
    std::string message;
    bool opened = false;
    // Inside the arena: elsewhere Embree limits TBB to the machine's threads, and TBB says so on stderr.
    arena_->execute([&] { opened = embree_.open(threads, message); });
    if (!opened) {
        return Status::error(StatusCode::no_device, "target core: " + message);
    }
    return std::string("CPU, Embree " RTC_VERSION_STRING ", ") + kernels().name;
}

void TargetCore::set_materials(uint32_t first, std::span<const CoreMaterial> materials) {
    materials_.resize(std::max(materials_.size(), first + materials.size()));
    std::copy(materials.begin(), materials.end(), materials_.begin() + first);
    materials_dirty_ = true;
}

void TargetCore::set_lights(const CoreLights& lights) {
    pack_lights(lights, tables_);
    total_light_weight_ = lights.total_weight;
    light_features_ = light_features(lights);
}

void TargetCore::set_sky(const CoreSky& sky) {
    pack_sky(sky, tables_);
    sky_radiance_ = sky.radiance;
    sky_width_ = sky.width;
    sky_height_ = sky.height;
    sky_light_probability_ = sky.light_probability;
}

void TargetCore::set_mesh(uint32_t mesh, const CoreMesh& data) {
    meshes_.set_mesh(mesh, data);
    geometry_dirty_ = true;
}

void TargetCore::set_instance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) {
    meshes_.set_instance(instance, mesh, transform);
    geometry_dirty_ = true;
}

// Builds what changed since the last Render.
Status TargetCore::prepare() {
    bool new_passing = false;
    if (materials_dirty_) {
        pack_materials(materials_, tables_);
        new_passing = meshes_.passing_changed(materials_);
        geometry_dirty_ = geometry_dirty_ || new_passing;
    }
    if (geometry_dirty_) {
        auto start = std::chrono::steady_clock::now();
        meshes_.place(materials_, ray_reach_, options().still);
        meshes_.find_coincident(coincident_);  // before the tree, whose memory it does not need
        std::string message;
        bool built = false;
        const GeometryEdits& edits = meshes_.edits();
        // In exact mode all is one tree of triangles in world space.
        const bool anew = edits.shape || new_passing || options().exact || embree_.stands_still();
        arena_->execute([&] {
            built = anew ? embree_.build(meshes_.geometry(), options().exact, meshes_.is_alive(), message)
                         : embree_.update(meshes_.geometry(), edits.moved, edits.deformed, edits.worn, message);
        });
        if (!built) {
            meshes_.start_anew();
            return Status::out_of_memory("target core: " + message, host_bytes(), 0);
        }
        meshes_.settle();
        stats().build_ms = milliseconds_since(start);
    }
    if (materials_dirty_ || geometry_dirty_) {
        opacities_.clear();
        for (const CoreMaterial& material : materials_) {
            opacities_.push_back(opacity_code(material, meshes_.has_colors()));
        }
        pack_coincident_rows();
    }
    geometry_dirty_ = false;
    materials_dirty_ = false;
    features_ = material_features(materials_) | tables_.texture_features | light_features_ |
                meshes_.features(materials_) | (sky_width_ > 0 ? FEATURE_SKY_MAP : 0u) |
                (coincident_.empty() ? 0u : FEATURE_COINCIDENT);
    return Status::success();
}

// Here a triangle's handle is its number in the mesh.
void TargetCore::pack_coincident_rows() {
    coincident_rows_.clear();
    const auto triangle_of = [this](const TriangleName& name) {
        const InstanceGeometry& geometry = meshes_.geometry()[name.instance];
        const float opacity = geometry.lets_rays_pass ? opacities_[geometry.triangles[name.primitive].w] : 1.0f;
        return CoincidentTriangle{name.primitive, opacity};
    };
    for (const glm::uvec4& row : pack_coincident(coincident_.entries(), triangle_of)) {
        coincident_rows_.push_back(uvec4(row.x, row.y, row.z, row.w));
    }
}

Settings TargetCore::frame_settings(const ViewPyramid& view) const {
    Screen screen = screen_of(view, target().height);
    Settings frame{};
    frame.eye = to_row(view.eye, screen.pixel_angle);
    frame.screen = to_row(screen.corner);
    frame.screen_right = to_row(screen.right);
    frame.screen_down = to_row(screen.down);
    frame.lens_right = to_row(screen.lens_right, view.aperture);
    frame.lens_down = to_row(screen.lens_down, screen.parallel_pixel);
    frame.sky_radiance = to_row(sky_radiance_);
    frame.scene_extent = vec4(0.0f);
    frame.width = target().width;
    frame.height = target().height;
    frame.pixel_count = target().width * target().height;
    frame.seed = settings().seed;
    frame.max_path_length = settings().max_path_length;
    frame.russian_roulette = settings().russian_roulette ? 1u : 0u;
    frame.next_event_estimation = settings().next_event_estimation ? 1u : 0u;
    frame.indirect_limit = settings().indirect_limit;
    frame.light_count = static_cast<uint>(tables_.light_table.size());
    frame.features = features_;
    frame.sky_width = sky_width_;
    frame.sky_height = sky_height_;
    frame.sky_light_probability = sky_light_probability_;
    frame.light_weight_scale = total_light_weight_ > 0.0f ? 1.0f / total_light_weight_ : 0.0f;
    return frame;
}

Settings TargetCore::filter_settings(const ViewPyramid& view) const {
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
        to_row(before.frame > 1 ? before.view.eye : view.eye, screen.parallel_pixel > 0.0f ? 1.0f : 0.0f);
    frame.screen_before = to_row(screen.corner);
    frame.screen_right_before = to_row(screen.right);
    frame.screen_down_before = to_row(screen.down);
    return frame;
}

Bindings TargetCore::bindings() {
    Bindings bindings;
    bindings.mesh_triangles = meshes_.mesh_triangles().data();
    bindings.vertices = meshes_.vertices().data();
    bindings.instances = meshes_.instances().data();
    bindings.materials = tables_.materials.data();
    bindings.texture_slots = tables_.texture_slots.data();
    bindings.textures = tables_.textures.data();
    bindings.texels = tables_.texels.data();
    bindings.lights = tables_.lights.data();
    bindings.light_table = tables_.light_table.data();
    bindings.sky_texels = tables_.sky_texels.data();
    bindings.sky_table = tables_.sky_table.data();
    bindings.lobe_energy = tables_.lobe_energy.data();
    bindings.coincident = coincident_rows_.data();
    bindings.opacities = opacities_.data();
    bindings.geometry = meshes_.geometry().data();
    bindings.scene = embree_.scene();
    bindings.accumulator = accumulator_.data();
    bindings.guides = guides_.data();
    bindings.filter_picture = filter_picture_.data();
    bindings.planes = planes_.data() + plane_margin_;
    bindings.plane_stride = planes_.size() / PLANES;
    bindings.motions = motions_.data();
    bindings.history = history_.data();
    bindings.history_before = history_before_.data();
    return bindings;
}

// Rays from far away are tested against triangles that they miss by more than boxes are padded otherwise.
Status TargetCore::reach_for(const ViewPyramid& view) {
    const glm::vec3 far = glm::abs(view.eye);
    const float reach = std::max({far.x, far.y, far.z});
    // Within four times the scene what boxes are padded by for themselves has been enough.
    const bool is_near = reach <= std::max(ray_reach_, 4.0f * embree_.largest_coordinate());
    if (!options().exact || is_near) return Status::success();
    ray_reach_ = 2.0f * reach;  // so that an eye on the move does not build anew at every step
    geometry_dirty_ = true;
    return prepare();
}

Frame TargetCore::frame_of(const ViewPyramid& view) {
    Frame frame;
    frame.kernels = &kernels();
    frame.bindings = bindings();
    frame.settings = frame_settings(view);
    return frame;
}

Status TargetCore::render(const ViewPyramid& view, uint32_t samples, CallOff& call_off) {
    auto start = std::chrono::steady_clock::now();
    if (const Status status = reach_for(view); !status.ok()) return status;
    std::optional<RayLog> log;
    if (measures_limit_ && !options().exact) {
        log.emplace();
    }
    Frame frame = frame_of(view);
    frame.samples_in_sum = static_cast<uint>(stats().samples);
    frame.first_sample = settings().first_sample + frame.samples_in_sum;
    frame.sample_count = samples;
    frame.watch = watch();
    frame.pixels = target().pixels;
    frame.first_pixel = target().first_pixel;
    frame.pixel_count = static_cast<uint>(target().sums.empty() ? target().pixels.size() : target().sums.size());
    frame.sums = target().sums;
    frame.squares = target().squares;
    frame.call_off = &call_off;
    FrameStats rendered;
    arena_->execute([&] { rendered = render_frame(frame, workers_, log ? &*log : nullptr); });
    double threads = stats().threads;
    stats().primary_rays += rendered.primary_rays;
    stats().extension_rays += rendered.extension_rays;
    stats().shadow_rays += rendered.shadow_rays;
    stats().generate_ms += rendered.generate_ms / threads;
    stats().extend_ms += rendered.extend_ms / threads;
    stats().shade_ms += rendered.shade_ms / threads;
    stats().connect_ms += rendered.connect_ms / threads;
    stats().finalize_ms += rendered.finalize_ms / threads;
    stats().total_ms += milliseconds_since(start);
    limit_ms_ = 0.0;
    limit_rays_ = log ? log->count() : 0;
    if (log) {
        arena_->execute([&] { limit_ms_ = log->replay(embree_.device(), embree_.scene()); });
    }
    return call_off.status();
}

uint64_t TargetCore::host_bytes() const {
    auto bytes = [](const auto& rows) { return rows.capacity() * sizeof(rows[0]); };
    return meshes_.memory_bytes() + embree_.memory_bytes() + bytes(accumulator_) + guides_.bytes() +
           filter_picture_.bytes() + planes_.bytes() + bytes(motions_) + bytes(history_) + bytes(history_before_) +
           bytes(tables_.materials) + bytes(tables_.texture_slots) + bytes(tables_.textures) + bytes(tables_.texels) +
           bytes(tables_.lights) + bytes(tables_.light_table) + bytes(tables_.sky_texels) + bytes(tables_.sky_table) +
           bytes(tables_.lobe_energy) + bytes(coincident_rows_);
}

// The camera rays of these samples, as far as pixels want them, whose guides are added to those there are.
void TargetCore::gather_guides(Frame& frame, uint first_sample, uint samples) {
    const auto start = std::chrono::steady_clock::now();
    frame.first_sample = first_sample;
    frame.sample_count = samples;
    FrameStats gathered;
    arena_->execute([&] {
        // Tiles write all over it as soon as the first one is done.
        make_memory(std::exchange(untouched_picture_, {}));
        make_memory(std::exchange(untouched_planes_, {}));
        gathered = render_frame(frame, workers_, nullptr);
    });
    stats().guide_ms += milliseconds_since(start) - gathered.filter_ms / stats().threads;
}

// Buffers, and what moved. The picture comes in, and guides are cleared, tile by tile.
void TargetCore::make_filter(const CoreFilter& filter) {
    const bool with_history = filter.history != FilterHistory::none;
    const size_t pixels = filter.means.size();
    // The last packet of lanes reads beyond the last pixel, and what is beside the first and the last ones is no pixel.
    guides_.ensure((pixels + SPARE_ROWS) * guide_rows(filter) * 4);
    untouched_picture_ = filter_picture_.ensure(pixels + SPARE_ROWS);
    const size_t margin = filter_margin(target().width);
    if (margin != plane_margin_) give_back(planes_);
    plane_margin_ = margin;
    untouched_planes_ = planes_.ensure((pixels + 2 * margin) * PLANES);
    motions_.clear();
    if (!with_history) return;
    const size_t numbers = pixels * HISTORY_PLANES + SPARE_ROWS;
    std::swap(history_, history_before_);
    if (frame_before().frame == 1) {
        history_before_.assign(numbers, 0.0f);
    }
    history_before_.resize(numbers);
    history_.resize(numbers);
    std::transform(frame_before().motions.begin(), frame_before().motions.end(), std::back_inserter(motions_),
                   [](const glm::vec4& row) { return to_row(glm::vec3(row), row.w); });
}

// Copied at the end alone: a filter that is called off leaves it as it was.
void TargetCore::hand_over(std::span<glm::vec4> filtered) {
    constexpr uint PART = 4096;
    const uint pixels = static_cast<uint>(filtered.size());
    arena_->execute([&] {
        for_each_tile((pixels + PART - 1) / PART, [&](uint part) {
            const vec4* rows = filter_picture_.data();
            const uint first = part * PART;
            std::transform(rows + first, rows + std::min(first + PART, pixels), filtered.begin() + first,
                           [](const vec4& p) { return glm::vec4(p.x, p.y, p.z, 1.0f); });
        });
    });
}

Status TargetCore::filter(const ViewPyramid& view, const CoreFilter& filter, CallOff& call_off) {
    if (const Status status = reach_for(view); !status.ok()) return status;
    const auto start = std::chrono::steady_clock::now();
    make_filter(filter);
    Frame frame = frame_of(view);
    frame.settings = filter_settings(view);
    frame.first_pixel = 0;
    frame.pixel_count = static_cast<uint>(filter.means.size());
    frame.rays_of_all = guide_rays(filter, FEWEST_GUIDE_RAYS);
    const uint own = std::min(filter.samples, filter.most_rays);
    const uint rays = guide_rays(filter, MOST_GUIDE_RAYS);
    frame.call_off = &call_off;
    frame.guides = true;
    frame.guide_rows = guide_rows(filter);
    frame.divides = &filter;
    frame.prepares = rays <= own;
    stats().guide_ms = 0.0;
    gather_guides(frame, filter.first_sample, own);
    frame.guide_rows = 0;
    frame.divides = nullptr;
    frame.prepares = true;
    if (rays > own) gather_guides(frame, filter.first_sample + own, rays - own);
    const bool with_history = filter.history != FilterHistory::none;
    arena_->execute([&] { run_filter(frame, filter.samples, with_history); });
    if (call_off.came()) {
        if (with_history) {
            std::swap(history_, history_before_);  // as they were; what they are written to is not read any more
        }
        return call_off.status();
    }
    hand_over(filter.filtered);
    stats().filter_ms = milliseconds_since(start) - stats().guide_ms;
    return Status::success();
}

Status TargetCore::read_history(std::vector<float>& planes) {
    planes.assign(history_.begin(), history_.end() - std::min<size_t>(history_.size(), SPARE_ROWS));
    return Status::success();
}

Status TargetCore::write_history(std::span<const float> planes) {
    if (planes.size() != target().pixels.size() * HISTORY_PLANES)
        return Status::invalid("target core: the history is of another size or core");
    history_.assign(planes.begin(), planes.end());
    history_.resize(planes.size() + SPARE_ROWS);
    return Status::success();
}

void TargetCore::close() {
    embree_.close();
    meshes_ = {};
    tables_ = {};
    coincident_ = {};
    give_back(coincident_rows_);
    give_back(accumulator_);
    give_back(guides_);
    give_back(filter_picture_);
    give_back(planes_);
    plane_margin_ = 0;
    give_back(motions_);
    give_back(history_);
    give_back(history_before_);
    workers_.clear();
    arena_.reset();
    parallelism_.reset();
}

}  // namespace

std::unique_ptr<CoreAPI> create_core() { return std::make_unique<TargetCore>(); }

}  // namespace target_core

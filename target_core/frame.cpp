// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/frame.h"

#include <sys/mman.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

#include "target_core/device/float_mode.h"
#include "target_core/device/parallel.h"
#include "target_core/device/surface_order.h"
#include "target_core/device/tile_watch.h"

namespace target_core {

using render_system::PathKernel;
using render_system::PathWatch;

namespace {

using Clock = std::chrono::steady_clock;

constexpr uint FILTER_STEPS[] = {1, 2, 4};

/// Adds the time between two calls to a counter.
class Stopwatch {
public:
    void lap(double& milliseconds) {
        Clock::time_point now = Clock::now();
        milliseconds += std::chrono::duration<double, std::milli>(now - last_).count();
        last_ = now;
    }
    void restart() { last_ = Clock::now(); }

private:
    Clock::time_point last_ = Clock::now();
};

struct Worker {
    Tile tile;
    FrameStats stats;
};

void next_segment(Tile& tile) {
    std::swap(tile.current, tile.next);
    tile.next.count = 0;
    tile.surface_count = 0;
    tile.shadow_count = 0;
}

// One sample of every path of the tile that is bound.
void render_sample(const KernelTable& kernels, Worker& worker, RayLog* log, PathWatch* observer) {
    Tile& tile = worker.tile;
    FrameStats& stats = worker.stats;
    Stopwatch watch;
    auto show = [&](PathKernel kernel) {
        if (observer) {
            show_tile(*observer, tile, kernel);
            watch.restart();
        }
    };
    tile.next.count = 0;
    kernels.generate();
    watch.lap(stats.generate_ms);
    show(PathKernel::generate);
    stats.primary_rays += tile.next.count;
    for (uint segment = 1; segment <= settings.max_path_length; ++segment) {
        next_segment(tile);
        if (tile.current.count == 0) {
            break;
        }
        stats.extension_rays += segment > 1 ? tile.current.count : 0;
        pass.segment = segment;
        if (log) {
            log->record_extension_rays(tile, segment == 1);
            watch.restart();
        }
        kernels.extend();
        watch.lap(stats.extend_ms);
        show(PathKernel::extend);
        // Camera rays meet their surfaces in order.
        if (segment > 1 && kernels.lanes > 1) {
            order_surfaces(tile);
        }
        kernels.shade();
        watch.lap(stats.shade_ms);
        show(PathKernel::shade);
        stats.shadow_rays += tile.shadow_count;
        if (log) {
            log->record_shadow_rays(tile);
            watch.restart();
        }
        kernels.connect();
        watch.lap(stats.connect_ms);
        show(PathKernel::connect);
    }
    kernels.finalize();
    watch.lap(stats.finalize_ms);
    show(PathKernel::finalize);
}

// The camera rays of one sample, of the pixels that take it, for what they met and what lit that.
void gather_sample(const KernelTable& kernels, Tile& tile) {
    tile.next.count = 0;
    kernels.generate();
    tile.next.count = 0;
    pass.filter_stage = FILTER_CHOOSE;
    kernels.filter();
    for (uint segment = 1; segment <= settings.max_path_length; ++segment) {
        next_segment(tile);
        if (tile.current.count == 0) {
            break;
        }
        pass.segment = segment;
        kernels.extend();
        if (segment == 1) {
            kernels.guide();
        } else if (kernels.lanes > 1) {
            order_surfaces(tile);
        }
        kernels.shade();
        kernels.connect();
    }
    pass.filter_stage = FILTER_GATHER;
    kernels.filter();
}

// The last packet of lanes reads beyond the last pixel.
void clear_guides(const Frame& frame, uint first_pixel, uint path_count) {
    const bool is_last = first_pixel + path_count == frame.first_pixel + frame.pixel_count;
    const size_t pixels = path_count + (is_last ? SPARE_ROWS : 0);
    const size_t a_pixel = size_t{4} * frame.guide_rows;
    std::fill_n(bound.guides + first_pixel * a_pixel, pixels * a_pixel, 0.0f);
}

void take_picture(const render_system::CoreFilter& filter, uint first, uint end) {
    for (size_t pixel = first; pixel < end; ++pixel) {
        const glm::vec4& mean = filter.means[pixel];
        const float variance = filter.variances.empty() ? -1.0f : filter.variances[pixel];
        const bool known = filter.knows(pixel);
        bound.filter_picture[pixel] =
            vec4(known ? mean.x : 0.0f, known ? mean.y : 0.0f, known ? mean.z : 0.0f, known ? variance : NO_MEAN);
    }
}

// What a filter makes of a tile's guides by pixels alone.
void use_guides(const Frame& frame, Worker& worker) {
    Stopwatch watch;
    pass.sample_scale = 1.0f / static_cast<float>(frame.sample_count);
    if (frame.divides) {
        pass.filter_stage = FILTER_DIVIDE;
        take_picture(*frame.divides, pass.first_pixel, pass.first_pixel + pass.path_count);
        frame.kernels->filter();
    }
    if (frame.prepares) {
        pass.filter_stage = FILTER_PREPARE;
        frame.kernels->filter();
    }
    watch.lap(worker.stats.filter_ms);
}

void render_tile(const Frame& frame, uint first_pixel, uint path_count, Worker& worker, RayLog* log) {
    KeepDenormals keep;
    reach_thread_memory();
    bound = frame.bindings;
    bound.tile = &worker.tile;
    settings = frame.settings;
    const vec4* target = worker.tile.target.get();
    uint place = first_pixel - frame.first_pixel;
    pass.first_pixel = first_pixel;
    pass.path_count = path_count;
    if (frame.guide_rows > 0) {
        clear_guides(frame, first_pixel, path_count);
    }
    for (uint i = 0; i < frame.sample_count; ++i) {
        if (frame.is_called_off()) {
            return;
        }
        uint in_sum = frame.sums.empty() ? frame.samples_in_sum + i : 0;
        pass.sample_index = frame.first_sample + i;
        pass.segment = 0;
        pass.sample_scale = 1.0f / static_cast<float>(in_sum + 1);
        pass.first_in_sum = in_sum == 0 ? 1u : 0u;
        if (frame.guides) {
            pass.filter_step = frame.rays_of_all;
            gather_sample(*frame.kernels, worker.tile);
            continue;
        }
        render_sample(*frame.kernels, worker, log, frame.watch);
        if (!frame.sums.empty()) {
            render_system::add_samples(frame.sums.subspan(place, path_count),
                                       render_system::part_of_squares(frame.squares, place, path_count), target);
        }
    }
    if (frame.guides) {
        use_guides(frame, worker);
        return;
    }
    if (!frame.sums.empty()) {
        return;
    }
    std::transform(target, target + path_count, frame.pixels.begin() + first_pixel,
                   [](const vec4& p) { return glm::vec4(p.x, p.y, p.z, p.w); });
}

// Enough tiles that the last ones leave no thread waiting for long. One thread waits for nobody, and large tiles have
// more paths alike: those of 2,048 take a tenth less time a path than those of 256.
uint paths_per_tile(uint pixels) {
    constexpr uint TILES_PER_THREAD = 32;
    constexpr uint FEWEST = 256;
    const uint threads = static_cast<uint>(tbb::this_task_arena::max_concurrency());
    if (threads == 1) {
        return TILE_PATHS;
    }
    uint tiles = threads * TILES_PER_THREAD;
    uint even = (pixels / tiles + TILE_GRAIN - 1) / TILE_GRAIN * TILE_GRAIN;
    return std::clamp(even, FEWEST, TILE_PATHS);
}

}  // namespace

void FrameStats::add(const FrameStats& other) {
    primary_rays += other.primary_rays;
    extension_rays += other.extension_rays;
    shadow_rays += other.shadow_rays;
    generate_ms += other.generate_ms;
    extend_ms += other.extend_ms;
    shade_ms += other.shade_ms;
    connect_ms += other.connect_ms;
    finalize_ms += other.finalize_ms;
    filter_ms += other.filter_ms;
}

struct Workers::Threads {
    tbb::enumerable_thread_specific<Worker> workers;
};

Workers::Workers() : threads_(std::make_unique<Threads>()) {}
Workers::~Workers() = default;
void Workers::clear() { threads_->workers.clear(); }

FrameStats render_frame(const Frame& frame, Workers& workers, RayLog* log) {
    for (Worker& worker : workers.threads_->workers) {
        worker.stats = {};  // a frame that failed may have left some
    }
    uint pixels = frame.pixel_count;
    uint tile_paths = paths_per_tile(pixels);
    for_each_tile((pixels + tile_paths - 1) / tile_paths, [&](uint tile) {
        uint first = tile * tile_paths;
        render_tile(frame, frame.first_pixel + first, std::min(tile_paths, pixels - first),
                    workers.threads_->workers.local(), log);
    });
    FrameStats stats;
    for (const Worker& worker : workers.threads_->workers) {
        stats.add(worker.stats);
    }
    return stats;
}

namespace {

// One run of a kernel of the filter over all pixels.
struct FilterStage {
    Pass pass;  // but for which pixels
    void (*kernel)() = nullptr;
    uint rows_behind = 0;  // the stage before: that has done what this one reads, and read what this one writes over
};

// The stages in their order. What one of them leaves in which planes the next ones know by their passes.
std::vector<FilterStage> filter_stages(const KernelTable& kernels, uint samples, bool with_history) {
    std::vector<FilterStage> stages;
    Pass next{};
    next.sample_scale = 1.0f / static_cast<float>(samples);
    next.filter_from = PLANE_LIGHT;
    next.filter_to = PLANE_OTHER_LIGHT;
    const auto stage = [&](uint which, void (*kernel)(), uint rows_behind) {
        next.filter_stage = which;
        stages.push_back({next, kernel, rows_behind});
        std::swap(next.filter_from, next.filter_to);
    };
    if (with_history) {
        stage(REPROJECT_LIGHT, kernels.reproject, 0);
    }
    stage(FILTER_STEADY, kernels.filter, 1);
    for (const uint step : FILTER_STEPS) {
        next.filter_step = step;
        stage(FILTER_LEVEL, kernels.filter, step);
    }
    // With a history it leaves the picture in planes, over what the last level reads.
    stage(FILTER_FINISH, kernels.filter, with_history ? std::end(FILTER_STEPS)[-1] : 1);
    if (with_history) {
        stage(REPROJECT_PICTURE, kernels.reproject, 1);
    }
    return stages;
}

// Binds what kernels of the filter reach to this thread, for as long as they run.
class FilterThread {
public:
    explicit FilterThread(const Frame& frame) {
        reach_thread_memory();
        bound = frame.bindings;
        settings = frame.settings;
    }
    void run(const FilterStage& stage, uint first, uint end) {
        if (first >= end) {
            return;
        }
        pass = stage.pass;
        pass.first_pixel = first;
        pass.path_count = end - first;
        stage.kernel();
    }

private:
    KeepDenormals keep_;
};

// A part of a picture. Stages stay back from its ends, each farther than the one before, but at the picture's.
struct Band {
    uint first;
    uint end;
    uint pixels;  // of the picture

    uint first_of(uint back) const { return first == 0 ? 0 : first + back; }
    uint end_of(uint back) const { return end == pixels ? pixels : end - back; }
};

// All stages by turns, a few rows at a time: what one writes the next ones read while it is in the cache.
void run_band(const Frame& frame, std::span<const FilterStage> stages, std::span<const uint> back, const Band& band) {
    constexpr uint CHUNK = 2048;
    FilterThread thread(frame);
    for (uint front = band.first; front < band.end + back.back() && !frame.is_called_off(); front += CHUNK) {
        for (size_t i = 0; i < stages.size(); ++i) {
            const auto reached = [&](uint place) {
                return std::clamp(std::max(place, back[i]) - back[i], band.first_of(back[i]), band.end_of(back[i]));
            };
            thread.run(stages[i], reached(front), reached(front + CHUNK));
        }
    }
}

// How many pixels each stage stays behind the first one, in whole packets of lanes.
std::vector<uint> pixels_behind(std::span<const FilterStage> stages, uint width) {
    std::vector<uint> back;
    uint sum = 0;
    for (const FilterStage& stage : stages) {
        sum += (stage.rows_behind * (width + 1) + TILE_GRAIN - 1) / TILE_GRAIN * TILE_GRAIN;
        back.push_back(sum);
    }
    return back;
}

}  // namespace

void make_memory(std::span<std::byte> memory) {
    constexpr size_t PART = size_t{2} << 20;  // a large page
    for_each_tile(static_cast<uint>((memory.size() + PART - 1) / PART), [&](uint part) {
        const std::span<std::byte> rest = memory.subspan(part * PART);
        madvise(rest.data(), std::min(rest.size(), PART), MADV_POPULATE_WRITE);
    });
}

size_t filter_margin(uint width) {
    const size_t reach = size_t{std::end(FILTER_STEPS)[-1]} * (width + 1) + SPARE_ROWS;
    return (reach + TILE_GRAIN - 1) / TILE_GRAIN * TILE_GRAIN;
}

void run_filter(const Frame& frame, uint samples, bool with_history) {
    constexpr uint BANDS_PER_THREAD = 3;
    constexpr uint FEWEST = 4096;
    const std::vector<FilterStage> stages = filter_stages(*frame.kernels, samples, with_history);
    const std::vector<uint> back = pixels_behind(stages, frame.settings.width);
    const uint pixels = frame.pixel_count;
    const uint threads = static_cast<uint>(tbb::this_task_arena::max_concurrency());
    const uint bands = std::clamp(pixels / std::max(4 * back.back(), FEWEST), 1u, threads * BANDS_PER_THREAD);
    const auto begin_of = [&](uint band) {
        const uint even = static_cast<uint>(uint64_t{pixels} * band / bands);
        return band == bands ? pixels : even / TILE_GRAIN * TILE_GRAIN;
    };
    // Bands at once, as far as no stage needs what is beyond their ends. What that leaves between two of them is done
    // by the thread that ends the second one: nobody waits for all, and much of it is in the cache.
    std::vector<std::atomic<uint>> ended(bands);  // of the two bands that meet where one begins
    const auto end_border = [&](uint band) {
        if (band == 0 || band == bands || ended[band].fetch_add(1) == 0 || frame.is_called_off()) {
            return;
        }
        FilterThread thread(frame);
        for (size_t i = 0; i < stages.size(); ++i) {
            thread.run(stages[i], begin_of(band) - back[i], begin_of(band) + back[i]);
        }
    };
    for_each_tile(bands, [&](uint band) {
        run_band(frame, stages, back, {begin_of(band), begin_of(band + 1), pixels});
        end_border(band);
        end_border(band + 1);
    });
}

}  // namespace target_core

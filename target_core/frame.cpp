// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/frame.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include <algorithm>
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

void render_tile(const Frame& frame, uint first_pixel, uint path_count, Worker& worker, RayLog* log) {
    KeepDenormals keep;
    reach_thread_memory();
    bound = frame.bindings;
    bound.tile = &worker.tile;
    settings = frame.settings;
    const vec4* target = worker.tile.target.get();
    uint place = first_pixel - frame.first_pixel;
    for (uint i = 0; i < frame.sample_count; ++i) {
        uint in_sum = frame.sums.empty() ? frame.samples_in_sum + i : 0;
        pass.sample_index = frame.first_sample + i;
        pass.segment = 0;
        pass.first_pixel = first_pixel;
        pass.path_count = path_count;
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
    if (!frame.sums.empty() || frame.guides) {
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

void run_filter_stage(const Frame& frame, const Pass& stage, void (*kernel)()) {
    constexpr uint CHUNK = TILE_PATHS;
    for_each_tile((frame.pixel_count + CHUNK - 1) / CHUNK, [&](uint chunk) {
        KeepDenormals keep;
        reach_thread_memory();
        bound = frame.bindings;
        settings = frame.settings;
        pass = stage;
        pass.first_pixel = chunk * CHUNK;
        pass.path_count = std::min(CHUNK, frame.pixel_count - pass.first_pixel);
        kernel();
    });
}

void run_filter(const Frame& frame, uint samples, bool with_history) {
    const auto filter = frame.kernels->filter, reproject = frame.kernels->reproject;
    Pass next{};
    next.filter_from = PLANE_LIGHT;
    next.filter_to = PLANE_OTHER_LIGHT;
    const auto stage = [&](uint which, void (*kernel)()) {
        next.filter_stage = which;
        run_filter_stage(frame, next, kernel);
        std::swap(next.filter_from, next.filter_to);
    };
    next.sample_scale = 1.0f / static_cast<float>(samples);
    next.filter_stage = FILTER_PREPARE;
    run_filter_stage(frame, next, filter);
    if (with_history) {
        stage(REPROJECT_LIGHT, reproject);
    }
    stage(FILTER_STEADY, filter);
    // Direct light goes to the planes that are free now, and leaves its own to the levels of the rest.
    const uint light = std::exchange(next.filter_from, PLANE_DIRECT), direct = next.filter_to;
    stage(FILTER_DIRECT, filter);
    next.filter_from = light;
    next.filter_to = PLANE_DIRECT;
    for (const uint step : FILTER_STEPS) {
        next.filter_step = step;
        stage(FILTER_LEVEL, filter);
    }
    next.filter_to = direct;
    stage(FILTER_FINISH, filter);
    if (with_history) {
        stage(REPROJECT_PICTURE, reproject);
    }
}

}  // namespace target_core

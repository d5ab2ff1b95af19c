// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec4.hpp>
#include <memory>
#include <span>

#include "render_system/call_off.h"
#include "render_system/core_data.h"
#include "render_system/path_watch.h"
#include "render_system/pixel_sum.h"
#include "target_core/device/bindings.h"
#include "target_core/device/kernel_table.h"
#include "target_core/device/ray_log.h"

namespace target_core {

/// Rays and thread time of the kernels, of one thread or summed over threads.
struct FrameStats {
    uint64_t primary_rays = 0;
    uint64_t extension_rays = 0;
    uint64_t shadow_rays = 0;
    double generate_ms = 0.0;
    double extend_ms = 0.0;
    double shade_ms = 0.0;
    double connect_ms = 0.0;
    double finalize_ms = 0.0;
    double filter_ms = 0.0;  // what is done of a filter while guides are in the cache

    void add(const FrameStats& other);
};

/// What one call renders: samples [first_sample, first_sample + sample_count) of every pixel, added to the
/// `samples_in_sum` that the accumulator holds.
struct Frame {
    const KernelTable* kernels = &one_lane_kernels;
    Bindings bindings;
    Settings settings;
    uint first_sample = 0;
    uint sample_count = 0;
    uint samples_in_sum = 0;
    render_system::PathWatch* watch = nullptr;  // or what is shown every path after every kernel
    std::span<glm::vec4> pixels;                // the host's; a tile's are copied there while they are in the cache
    uint first_pixel = 0;                       // of the `pixel_count` that are rendered
    uint pixel_count = 0;
    std::span<render_system::PixelSum> sums;  // or where samples go in place of `pixels`, one for each pixel rendered
    std::span<double> squares;
    bool guides = false;   // the first segments of paths, for the guides of a filter
    uint guide_rows = 0;   // of a pixel, cleared before the first of them; 0: some are there
    uint rays_of_all = 0;  // so many of them in every pixel, then where more are wanted
    const render_system::CoreFilter* divides = nullptr;  // after them FILTER_DIVIDE of this picture: they were the rays
                                                         // of its samples
    bool prepares = false;                               // after them FILTER_PREPARE: these were the last
    render_system::CallOff* call_off = nullptr;          // or what is asked before every sample of a tile

    bool is_called_off() const { return call_off && call_off->came(); }
};

/// A tile for each thread, kept from frame to frame.
class Workers {
public:
    Workers();
    ~Workers();

    /// Gives the tiles' memory back.
    void clear();

private:
    friend FrameStats render_frame(const Frame& frame, Workers& workers, RayLog* log);
    struct Threads;
    std::unique_ptr<Threads> threads_;
};

/// Has the system make memory, which begins where a page does, on all threads of the current task arena: those that
/// write to it first would wait for it. Where it cannot, they do.
void make_memory(std::span<std::byte> memory);

/// How far planes go on before and behind a picture so wide: what taps read there is zero.
size_t filter_margin(uint width);

/// Filters the light that FILTER_DIVIDE and FILTER_PREPARE have left of a mean of so many samples into the filter's
/// picture, by guides, with the history that is bound. Where it is called off it leaves the rest as it is.
void run_filter(const Frame& frame, uint samples, bool with_history);

/// Renders all tiles of the frame on the threads of the current task arena. Each tile of paths runs through the whole
/// wavefront on one thread, sample by sample, so the picture is the same on any number of threads. With `log`, the
/// rays are recorded there as well.
FrameStats render_frame(const Frame& frame, Workers& workers, RayLog* log);

}  // namespace target_core

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "source_core/wavefront.h"

namespace source_core {

using render_system::PathKernel;
using render_system::PathStates;

/// What takes the rows from the device to whoever watches, and host memory for them.
struct Wavefront::Watching {
    const Device& device;
    const Staging& staging;
    std::span<const uint32_t> primitives;
    render_system::PathWatch& watch;
    std::vector<float> origins, directions, throughputs, radiances;
    std::vector<float> shadow_origins, shadow_directions, shadow_contributions, means;
    std::vector<uint32_t> queue, surfaces;

    /// The first `count` rows of `buffer`, of `width` words each.
    template <class Word>
    Status fetch(const Buffer& buffer, uint32_t count, uint32_t width, std::vector<Word>& words,
                 std::span<const Word>& shown) {
        words.resize(size_t{count} * width);
        shown = words;
        return staging.download(device, buffer, std::as_writable_bytes(std::span(words)));
    }

    // From the slots of the table of triangles to triangles of meshes.
    void name_primitives() {
        for (size_t i = 2; i < surfaces.size(); i += 4) {
            surfaces[i] = surfaces[i] < primitives.size() ? primitives[surfaces[i]] : NONE;
        }
    }
};

Status Wavefront::show(PathKernel kernel, const Pass& pass, Watching& to) const {
    const bool queues = kernel != PathKernel::connect && kernel != PathKernel::finalize;
    const bool surfaces = kernel == PathKernel::extend || kernel == PathKernel::shade;
    const bool shadows = kernel == PathKernel::shade || kernel == PathKernel::connect;
    const bool paths = kernel == PathKernel::generate || kernel == PathKernel::shade;
    const auto rows = [this](uint32_t binding) -> const Buffer& { return rows_[binding - BINDING_PATH_ORIGIN]; };
    const auto jobs = [&](uint32_t segment, uint32_t counter) {
        return std::min(entries(segment, counter), pass.path_count);
    };
    PathStates states;
    states.kernel = kernel;
    states.segment = pass.segment;
    states.sample = pass.sample_index;
    states.first_pixel = pass.first_pixel;
    states.path_count = pass.path_count;

    constexpr uint32_t VEC4 = 4;
    Status status = Status::success();
    const auto fetch = [&](bool wanted, const Buffer& buffer, uint32_t count, uint32_t width, auto& words,
                           auto& shown) {
        if (wanted && status.ok()) {
            status = to.fetch(buffer, count, width, words, shown);
        }
    };
    fetch(paths, rows(BINDING_PATH_ORIGIN), pass.path_count, VEC4, to.origins, states.origins);
    fetch(paths, rows(BINDING_PATH_DIRECTION), pass.path_count, VEC4, to.directions, states.directions);
    fetch(paths, rows(BINDING_PATH_THROUGHPUT), pass.path_count, VEC4, to.throughputs, states.throughputs);
    fetch(kernel != PathKernel::finalize, rows(BINDING_PATH_RADIANCE), pass.path_count, VEC4, to.radiances,
          states.radiances);
    // The two queues exchange their roles from segment to segment.
    const uint32_t segment = pass.segment + (kernel == PathKernel::extend ? 0 : 1);
    fetch(queues, rows(segment % 2 == 1 ? BINDING_NEXT_QUEUE : BINDING_QUEUE), jobs(segment, COUNTER_EXTENSION), 1,
          to.queue, states.queue);
    fetch(surfaces, rows(BINDING_SURFACE_QUEUE), jobs(pass.segment, COUNTER_SURFACE), VEC4, to.surfaces,
          states.surfaces);
    const uint32_t shadow_rays = jobs(pass.segment, COUNTER_SHADOW);
    fetch(shadows, rows(BINDING_SHADOW_ORIGIN), shadow_rays, VEC4, to.shadow_origins, states.shadow_origins);
    fetch(shadows, rows(BINDING_SHADOW_DIRECTION), shadow_rays, VEC4, to.shadow_directions, states.shadow_directions);
    fetch(shadows, rows(BINDING_SHADOW_CONTRIBUTION), shadow_rays, VEC4, to.shadow_contributions,
          states.shadow_contributions);
    fetch(kernel == PathKernel::finalize, target_, pass.path_count, VEC4, to.means, states.means);
    if (status.ok()) {
        if (surfaces) {
            to.name_primitives();
        }
        to.watch.after(states);
    }
    return status;
}

Status Wavefront::watch_sample(const KernelSet& kernels, Pass pass, Watching& to, WavefrontCounts& counts) {
    Status status = Status::success();
    const auto step = [&](std::initializer_list<Kernel> wanted, PathKernel kernel) {
        if (status.ok()) {
            status = run_kernels(to.device, kernels, pass, wanted, counts);
        }
        if (status.ok()) {
            status = show(kernel, pass, to);
        }
    };
    step({Kernel::generate, Kernel::schedule}, PathKernel::generate);
    while (status.ok() && pass.segment < max_path_length_ && entries(pass.segment + 1, COUNTER_EXTENSION) > 0) {
        ++pass.segment;
        step({Kernel::extend}, PathKernel::extend);
        step({Kernel::shade, Kernel::schedule}, PathKernel::shade);
        step({Kernel::connect}, PathKernel::connect);
    }
    step({Kernel::finalize}, PathKernel::finalize);
    return status;
}

Status Wavefront::run_watched(const Device& device, const KernelSet& kernels, const BatchPass& batch,
                              const Staging& staging, std::span<const uint32_t> primitives,
                              render_system::PathWatch& watch, WavefrontCounts& counts) {
    Watching to{device, staging, primitives, watch, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
    for (uint32_t sample = 0; sample < batch.samples; ++sample) {
        Status status = watch_sample(kernels, pass_of(batch, sample), to, counts);
        if (!status.ok()) {
            return status;
        }
    }
    counts.primary_rays += uint64_t{batch.path_count} * batch.samples;
    return Status::success();
}

}  // namespace source_core

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "render_system/call_off.h"
#include "render_system/path_watch.h"
#include "source_core/device/buffer.h"
#include "source_core/device/kernel_set.h"
#include "source_core/scene_buffers.h"

namespace source_core {

/// Pixels and paths of one Render.
struct WavefrontSize {
    uint64_t pixels = 0;
    uint32_t batch = 0;  ///< paths that are on their way at once; the pixels are worked off in batches

    bool operator==(const WavefrontSize&) const = default;
};

/// Rays and device time of some samples.
struct WavefrontCounts {
    uint64_t primary_rays = 0;
    uint64_t extension_rays = 0;  ///< with the primary ones
    uint64_t shadow_rays = 0;
    double kernel_ms[KERNEL_COUNT] = {};
};

/// What a batch is run for: run, gather_guides, or what follows that.
enum class BatchUse { samples, guides, filter };

/// Samples to take of one batch.
struct BatchPass {
    uint32_t first_pixel = 0;
    uint32_t path_count = 0;
    uint32_t first_sample = 0;  ///< index of the first sample to take now
    uint32_t samples = 0;
    uint32_t samples_before = 0;  ///< in the accumulator already; 0 starts the sums
    BatchUse use = BatchUse::samples;
    uint32_t rays_of_all = 0;  ///< of guides: so many samples in every pixel, then where more are wanted
    uint32_t segments = 0;     ///< of guides: how many of each path
};

/// The buffers of path state and queues, and the loop over generate, extend, shade, connect and finalize. The kernels
/// of a batch run without the host: counters on the device size the next dispatches.
class Wavefront {
public:
    /// Bytes of all buffers of a wavefront of this size.
    static uint64_t bytes(const WavefrontSize& size, uint32_t max_path_length);

    static Result<Wavefront> create(const Device& device, MemoryBudget& budget, const WavefrontSize& size);

    const WavefrontSize& size() const { return size_; }

    /// Makes room for the counters of that many segments. To be called before bind.
    Status set_max_path_length(const Device& device, MemoryBudget& budget, uint32_t max_path_length);

    /// Points the kernels at the scene, the settings and one batch's part of the accumulator.
    void bind(const Device& device, const KernelSet& kernels, const KernelVariant& variant, const SceneBuffers& scene,
              const Settings& settings, const BatchPass& batch) const;

    /// Runs a batch and adds to `counts`. Work is cut into submissions of a fraction of a second; it asks before each
    /// whether it is called off.
    Status run(const Device& device, const KernelSet& kernels, const BatchPass& batch, render_system::CallOff& call_off,
               WavefrontCounts& counts);

    /// As run, kernel by kernel, with the paths shown to `watch` after each. `primitives` gives the triangle in its
    /// mesh of each slot of the table of triangles.
    Status run_watched(const Device& device, const KernelSet& kernels, const BatchPass& batch, const Staging& staging,
                       std::span<const uint32_t> primitives, render_system::PathWatch& watch, WavefrontCounts& counts);

    /// Makes room for what a filter needs beside the picture, unless it is there; with a history also for that and for
    /// so many rows of motions. To be called before bind. Fails with out_of_memory.
    Status make_filter(const Device& device, MemoryBudget& budget, bool with_history, uint64_t motion_rows);

    /// A new frame: what was remembered of the one before, or nothing if it is the first, lies before it. To be called
    /// before bind.
    Status turn_history(const Device& device, bool first);

    /// Drops the guides gathered so far.
    Status clear_guides(const Device& device);

    /// Traces the camera rays of a batch's samples, of the pixels that take them, and adds what they met and what lit
    /// that to the guides. Asks before every submission whether it is called off.
    Status gather_guides(const Device& device, const KernelSet& kernels, const BatchPass& batch,
                         render_system::CallOff& call_off, WavefrontCounts& counts);

    /// Divides filter_picture() by the albedo of the guides, which are those of its own samples.
    Status divide_by_albedo(const Device& device, const KernelSet& kernels, uint32_t samples, WavefrontCounts& counts);

    /// Filters what that has left of a mean of so many samples, by guides, into filter_picture().
    Status run_filter(const Device& device, const KernelSet& kernels, uint32_t samples, bool with_history,
                      WavefrontCounts& counts);

    /// Mean radiance and the variance of its luminance, then what the filter makes of them. Behind it lie motions.
    const Buffer& filter_picture() const { return filter_picture_; }

    /// What the frame filtered last has left.
    const Buffer& history() const { return histories_[0]; }

    /// The mean of the samples of the batch that ran last.
    const Buffer& target() const { return target_; }

private:
    struct Watching;
    struct Span {
        uint32_t first_sample;
        uint32_t samples;
        uint32_t first_segment;  // 0: from generate on
        uint32_t last_segment;
        bool finalize;
    };

    Wavefront() = default;
    Status create_query_pool(const Device& device);
    void bind_set(const Device& device, const KernelSet& kernels, const KernelVariant& variant,
                  const SceneBuffers& scene, const BatchPass& batch, uint32_t parity) const;
    using Work = std::function<void(VkCommandBuffer)>;
    void record(VkCommandBuffer commands, const Work& work);
    void record_sample(VkCommandBuffer commands, const KernelSet& kernels, const BatchPass& batch, const Span& span,
                       uint32_t sample);
    void record_stage(VkCommandBuffer commands, const KernelSet& kernels, Pass pass, Kernel kernel = Kernel::filter);
    void record_guides(VkCommandBuffer commands, const KernelSet& kernels, const BatchPass& batch, uint32_t sample);
    void clear_segments(VkCommandBuffer commands);
    void dispatch(VkCommandBuffer commands, const KernelSet& kernels, Kernel kernel, const Pass& pass);
    void stamp(VkCommandBuffer commands, uint32_t kernel);
    Status run_span(const Device& device, const KernelSet& kernels, const BatchPass& batch, const Span& span,
                    WavefrontCounts& counts);
    Status run_work(const Device& device, const Work& work, WavefrontCounts& counts);
    Status run_kernels(const Device& device, const KernelSet& kernels, const Pass& pass,
                       std::initializer_list<Kernel> wanted, WavefrontCounts& counts);
    Status watch_sample(const KernelSet& kernels, Pass pass, Watching& to, WavefrontCounts& counts);
    Status show(render_system::PathKernel kernel, const Pass& pass, Watching& to) const;
    Status read_times(const Device& device, WavefrontCounts& counts) const;
    uint32_t entries(uint32_t segment, uint32_t counter) const;
    static void kernel_barrier(VkCommandBuffer commands);
    static Pass pass_of(const BatchPass& batch, uint32_t sample);

    WavefrontSize size_;
    uint32_t max_path_length_ = 0;
    Buffer settings_;
    Buffer addresses_;
    std::vector<Buffer> rows_;  // bindings BINDING_PATH_ORIGIN to BINDING_SHADOW_CONTRIBUTION
    Buffer counters_;
    Buffer arguments_;
    Buffer accumulator_;
    Buffer target_;
    Buffer counters_copy_;
    Buffer guides_;  // these three: none until a filter is asked for
    Buffer filter_picture_;
    Buffer planes_;
    std::array<Buffer, 2> histories_;  // of this frame and of the one before; none until a filter has a history
    Handle<VkQueryPool> queries_;
    std::vector<uint32_t> stamps_;  // the kernel that ran before each timestamp
    double sample_ms_ = 0.0;        // of the batch at work, to size submissions
};

}  // namespace source_core

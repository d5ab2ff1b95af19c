// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>
#include <utility>

#include "source_core/wavefront.h"

namespace source_core {

namespace {

constexpr uint64_t FILTER_ROW = 16;
constexpr uint32_t FILTER_STEPS[] = {1, 2, 4};

}  // namespace

Status Wavefront::make_filter(const Device& device, MemoryBudget& budget, bool with_history, uint64_t motion_rows) {
    constexpr VkBufferUsageFlags USAGE =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    const uint64_t guide_rows = with_history ? GUIDE_ROWS + GUIDE_MOTION_ROWS : GUIDE_ROWS;
    const uint64_t history = with_history ? size_.pixels * HISTORY_PLANES * sizeof(float) : 0;
    const struct {
        Buffer* buffer;
        const char* name;
        uint64_t bytes;
    } wishes[] = {{&guides_, "guides of the filter", size_.pixels * guide_rows * FILTER_ROW},
                  {&filter_picture_, "picture to filter", (size_.pixels + motion_rows) * FILTER_ROW},
                  {&planes_, "planes of the filter", size_.pixels * PLANES * sizeof(float)},
                  {&histories_[0], "history of the filter", history},
                  {&histories_[1], "history of the filter", history}};
    for (const auto& wish : wishes) {
        const uint64_t bytes = wish.bytes;
        if (bytes == 0 || (*wish.buffer && wish.buffer->size() >= bytes)) {
            continue;
        }
        if (bytes > device.limits().storage_buffer_range) {
            // No limit on memory: it allows nothing that a higher one would not.
            return Status::out_of_memory(std::string("source core: the ") + wish.name + " are more than a kernel of " +
                                             device.name() + " reaches at once; use --core target",
                                         bytes, 0);
        }
        *wish.buffer = {};
        Result<Buffer> buffer = Buffer::create(device, budget, wish.name, bytes, USAGE, BufferPlace::device);
        if (!buffer.ok()) {
            return buffer.status;
        }
        *wish.buffer = std::move(*buffer);
    }
    return Status::success();
}

Status Wavefront::turn_history(const Device& device, bool first) {
    std::swap(histories_[0], histories_[1]);
    if (!first) {
        return Status::success();
    }
    return device.submit_and_wait(
        [&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, histories_[1].handle(), 0, VK_WHOLE_SIZE, 0); });
}

Status Wavefront::clear_guides(const Device& device) {
    return device.submit_and_wait(
        [&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, guides_.handle(), 0, VK_WHOLE_SIZE, 0); });
}

Status Wavefront::gather_guides(const Device& device, const KernelSet& kernels, const BatchPass& batch,
                                render_system::CallOff& call_off, WavefrontCounts& counts) {
    constexpr uint32_t TOGETHER = 4;
    Status status = Status::success();
    for (uint32_t done = 0; done < batch.samples && status.ok(); done += TOGETHER) {
        if (call_off.came()) {
            return call_off.status();
        }
        const uint32_t end = std::min(done + TOGETHER, batch.samples);
        const Work work = [&](VkCommandBuffer commands) {
            for (uint32_t sample = done; sample < end; ++sample) {
                record_guides(commands, kernels, batch, sample);
            }
        };
        status = run_work(device, work, counts);
    }
    return status;
}

void Wavefront::record_guides(VkCommandBuffer commands, const KernelSet& kernels, const BatchPass& batch,
                              uint32_t sample) {
    Pass pass = pass_of(batch, sample);
    pass.filter_step = batch.rays_of_all;
    clear_segments(commands);
    dispatch(commands, kernels, Kernel::generate, pass);
    kernel_barrier(commands);
    clear_segments(commands);
    pass.filter_stage = FILTER_CHOOSE;
    dispatch(commands, kernels, Kernel::filter, pass);
    kernel_barrier(commands);
    dispatch(commands, kernels, Kernel::schedule, pass);
    for (uint32_t segment = 1; segment <= batch.segments; ++segment) {
        pass.segment = segment;
        const auto run = [&](Kernel kernel) {
            kernel_barrier(commands);
            dispatch(commands, kernels, kernel, pass);
        };
        run(Kernel::extend);
        if (segment == 1) {
            run(Kernel::guide);
        }
        run(Kernel::shade);
        run(Kernel::schedule);
        run(Kernel::connect);
    }
    pass.filter_stage = FILTER_GATHER;
    kernel_barrier(commands);
    dispatch(commands, kernels, Kernel::filter, pass);
}

void Wavefront::record_stage(VkCommandBuffer commands, const KernelSet& kernels, Pass pass, Kernel kernel) {
    kernel_barrier(commands);
    for (uint64_t first = 0; first < size_.pixels; first += size_.batch) {
        pass.first_pixel = static_cast<uint32_t>(first);
        pass.path_count = static_cast<uint32_t>(std::min<uint64_t>(size_.batch, size_.pixels - first));
        dispatch(commands, kernels, kernel, pass);
    }
}

Status Wavefront::divide_by_albedo(const Device& device, const KernelSet& kernels, uint32_t samples,
                                   WavefrontCounts& counts) {
    Pass pass{};
    pass.sample_scale = 1.0f / static_cast<float>(samples);
    pass.filter_stage = FILTER_DIVIDE;
    return run_work(
        device, [&](VkCommandBuffer commands) { record_stage(commands, kernels, pass); }, counts);
}

Status Wavefront::run_filter(const Device& device, const KernelSet& kernels, uint32_t samples, bool with_history,
                             WavefrontCounts& counts) {
    const Work work = [&](VkCommandBuffer commands) {
        Pass pass{};
        pass.filter_from = PLANE_LIGHT;
        pass.filter_to = PLANE_OTHER_LIGHT;
        const auto stage = [&](uint32_t which, Kernel kernel) {
            pass.filter_stage = which;
            record_stage(commands, kernels, pass, kernel);
            std::swap(pass.filter_from, pass.filter_to);
        };
        pass.sample_scale = 1.0f / static_cast<float>(samples);
        pass.filter_stage = FILTER_PREPARE;
        record_stage(commands, kernels, pass);
        if (with_history) {
            stage(REPROJECT_LIGHT, Kernel::reproject);
        }
        stage(FILTER_STEADY, Kernel::filter);
        for (const uint32_t step : FILTER_STEPS) {
            pass.filter_step = step;
            stage(FILTER_LEVEL, Kernel::filter);
        }
        stage(FILTER_FINISH, Kernel::filter);
        if (with_history) {
            stage(REPROJECT_PICTURE, Kernel::reproject);
        }
    };
    return run_work(device, work, counts);
}

}  // namespace source_core

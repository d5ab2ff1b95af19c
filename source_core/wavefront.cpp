// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/wavefront.h"

#include <algorithm>
#include <chrono>
#include <cstring>

namespace source_core {

namespace {

constexpr uint32_t MOST_STAMPS = 8192;
constexpr uint32_t SEGMENTS_PER_SUBMISSION = 16;
constexpr uint32_t MOST_SAMPLES_PER_SUBMISSION = 32;
constexpr double SUBMISSION_MS = 200.0;
constexpr uint32_t NO_KERNEL = KERNEL_COUNT;
constexpr uint64_t ROW = 16;
constexpr uint32_t FIRST_ROWS = BINDING_PATH_ORIGIN;
constexpr uint32_t LAST_ROWS = BINDING_SHADOW_CONTRIBUTION;
constexpr VkBufferUsageFlags STORAGE = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

const char* const ROWS_NAMES[] = {
    "path origins", "path directions", "path throughputs", "path radiances",    "surface queue",
    "queue",        "next queue",      "shadow origins",   "shadow directions", "shadow contributions"};

uint64_t rows_bytes(uint32_t binding, uint32_t batch) {
    const bool queue = binding == BINDING_QUEUE || binding == BINDING_NEXT_QUEUE;
    return uint64_t{batch} * (queue ? sizeof(uint32_t) : ROW);
}

uint64_t counters_bytes(uint32_t max_path_length) {
    return (COUNTER_SEGMENTS + uint64_t{max_path_length + 2} * COUNTERS_PER_SEGMENT) * sizeof(uint32_t);
}

void barrier(VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written, VkPipelineStageFlags to,
             VkAccessFlags used) {
    VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    memory.srcAccessMask = written;
    memory.dstAccessMask = used;
    vkCmdPipelineBarrier(commands, from, to, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

uint32_t group_count(uint32_t jobs) { return (jobs + WORK_GROUP_SIZE - 1) / WORK_GROUP_SIZE; }

}  // namespace

// Between two kernels, the second of which may be dispatched by arguments that the first wrote.
void Wavefront::kernel_barrier(VkCommandBuffer commands) {
    barrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
            VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT);
}

uint64_t Wavefront::bytes(const WavefrontSize& size, uint32_t max_path_length) {
    uint64_t sum = sizeof(Settings) + TABLE_COUNT * ROW + ARGUMENTS_WORDS * sizeof(uint32_t);
    for (uint32_t binding = FIRST_ROWS; binding <= LAST_ROWS; ++binding) {
        sum += rows_bytes(binding, size.batch);
    }
    sum += 2 * counters_bytes(max_path_length);
    return sum + size.pixels * ROW + uint64_t{size.batch} * ROW;
}

Result<Wavefront> Wavefront::create(const Device& device, MemoryBudget& budget, const WavefrontSize& size) {
    Wavefront wavefront;
    wavefront.size_ = size;
    wavefront.rows_.resize(LAST_ROWS - FIRST_ROWS + 1);

    struct Wish {
        Buffer* buffer;
        const char* name;
        uint64_t bytes;
        VkBufferUsageFlags usage;
        BufferPlace place;
    };
    std::vector<Wish> wishes = {
        {&wavefront.settings_, "settings", sizeof(Settings), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, BufferPlace::upload},
        {&wavefront.addresses_, "addresses", TABLE_COUNT * ROW, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
         BufferPlace::upload},
        {&wavefront.arguments_, "arguments", ARGUMENTS_WORDS * sizeof(uint32_t),
         STORAGE | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, BufferPlace::device},
        {&wavefront.accumulator_, "accumulator", size.pixels * ROW, STORAGE, BufferPlace::device},
        {&wavefront.target_, "target", uint64_t{size.batch} * ROW, STORAGE | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
         BufferPlace::device}};
    for (uint32_t binding = FIRST_ROWS; binding <= LAST_ROWS; ++binding) {
        wishes.push_back({&wavefront.rows_[binding - FIRST_ROWS], ROWS_NAMES[binding - FIRST_ROWS],
                          rows_bytes(binding, size.batch), STORAGE | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                          BufferPlace::device});
    }
    for (const Wish& wish : wishes) {
        Result<Buffer> buffer = Buffer::create(device, budget, wish.name, wish.bytes, wish.usage, wish.place);
        if (!buffer.ok()) {
            return buffer.status;
        }
        *wish.buffer = std::move(*buffer);
    }
    const Status status = wavefront.create_query_pool(device);
    if (!status.ok()) {
        return status;
    }
    return Result<Wavefront>(std::move(wavefront));
}

Status Wavefront::set_max_path_length(const Device& device, MemoryBudget& budget, uint32_t max_path_length) {
    max_path_length_ = max_path_length;
    const uint64_t bytes = counters_bytes(max_path_length);
    if (counters_ && counters_.size() >= bytes) {
        return Status::success();
    }
    counters_ = {};
    counters_copy_ = {};
    Result<Buffer> counters = Buffer::create(
        device, budget, "counters", bytes,
        STORAGE | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::device);
    if (!counters.ok()) {
        return counters.status;
    }
    Result<Buffer> copy = Buffer::create(device, budget, "copy of the counters", bytes,
                                         VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::readback);
    if (!copy.ok()) {
        return copy.status;
    }
    counters_ = std::move(*counters);
    counters_copy_ = std::move(*copy);
    return Status::success();
}

Status Wavefront::create_query_pool(const Device& device) {
    if (device.limits().timestamp_ns == 0.0) {
        return Status::success();
    }
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = MOST_STAMPS;
    VkQueryPool pool = VK_NULL_HANDLE;
    const VkResult result = vkCreateQueryPool(device.handle(), &info, nullptr, &pool);
    if (result != VK_SUCCESS) {
        return vulkan_error("create a pool of timestamps", result);
    }
    queries_ = {device.handle(), pool, vkDestroyQueryPool};
    return Status::success();
}

void Wavefront::bind(const Device& device, const KernelSet& kernels, const KernelVariant& variant,
                     const SceneBuffers& scene, const Settings& settings, const BatchPass& batch) const {
    std::memcpy(settings_.mapped(), &settings, sizeof(settings));
    glm::uvec4 addresses[TABLE_COUNT] = {};
    for (uint32_t table = 0; table < TABLE_COUNT; ++table) {
        if (variant.tables[table] == TableAccess::address) {
            const VkDeviceAddress address = scene.buffer(table).address();
            addresses[table] = {static_cast<uint32_t>(address), static_cast<uint32_t>(address >> 32), 0u, 0u};
        }
    }
    std::memcpy(addresses_.mapped(), addresses, sizeof(addresses));
    bind_set(device, kernels, variant, scene, batch, 0);
    bind_set(device, kernels, variant, scene, batch, 1);
}

void Wavefront::bind_set(const Device& device, const KernelSet& kernels, const KernelVariant& variant,
                         const SceneBuffers& scene, const BatchPass& batch, uint32_t parity) const {
    std::array<VkDescriptorBufferInfo, BINDING_COUNT> buffers{};
    std::array<VkBufferView, TABLE_COUNT> views{};
    std::array<VkWriteDescriptorSet, BINDING_COUNT> writes{};
    for (uint32_t i = 0; i < BINDING_COUNT; ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = kernels.descriptor_set(parity);
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = descriptor_type(i, variant);
        writes[i].pBufferInfo = &buffers[i];
        buffers[i] = {VK_NULL_HANDLE, 0, VK_WHOLE_SIZE};
    }
    for (uint32_t table = 0; table < TABLE_COUNT; ++table) {
        views[table] = scene.view(table);
        writes[table].pTexelBufferView = &views[table];
        buffers[table].buffer = scene.buffer(table).handle();
        if (variant.tables[table] == TableAccess::address) {
            buffers[table].buffer = arguments_.handle();  // never read through the binding, but it must be something
        }
    }
    buffers[BINDING_SETTINGS].buffer = settings_.handle();
    buffers[BINDING_ADDRESSES].buffer = addresses_.handle();
    for (uint32_t binding = FIRST_ROWS; binding <= LAST_ROWS; ++binding) {
        buffers[binding].buffer = rows_[binding - FIRST_ROWS].handle();
    }
    if (parity == 1) {
        std::swap(buffers[BINDING_QUEUE].buffer, buffers[BINDING_NEXT_QUEUE].buffer);
    }
    buffers[BINDING_COUNTERS].buffer = counters_.handle();
    buffers[BINDING_ARGUMENTS].buffer = arguments_.handle();
    buffers[BINDING_ACCUMULATOR] = {accumulator_.handle(), uint64_t{batch.first_pixel} * ROW,
                                    uint64_t{batch.path_count} * ROW};
    buffers[BINDING_TARGET].buffer = target_.handle();
    if (batch.use != BatchUse::samples) {
        buffers[BINDING_GUIDES] = {guides_.handle(), 0, VK_WHOLE_SIZE};
        buffers[BINDING_FILTER_PICTURE].buffer = filter_picture_.handle();
    }
    if (batch.use == BatchUse::filter) {
        buffers[BINDING_PLANES].buffer = planes_.handle();
        if (histories_[0]) {
            buffers[BINDING_HISTORY].buffer = histories_[0].handle();
            buffers[BINDING_HISTORY_BEFORE].buffer = histories_[1].handle();
        }
    }
    vkUpdateDescriptorSets(device.handle(), BINDING_COUNT, writes.data(), 0, nullptr);
}

Status Wavefront::run(const Device& device, const KernelSet& kernels, const BatchPass& batch,
                      render_system::CallOff& call_off, WavefrontCounts& counts) {
    const bool in_one = max_path_length_ <= SEGMENTS_PER_SUBMISSION;
    uint32_t done = 0;
    while (done < batch.samples) {
        const double fitting = sample_ms_ > 0.0 ? SUBMISSION_MS / sample_ms_ : 1.0;
        const double most = in_one ? static_cast<double>(MOST_SAMPLES_PER_SUBMISSION) : 1.0;
        const auto samples = static_cast<uint32_t>(std::clamp(fitting, 1.0, most));
        Span span{done, std::min(samples, batch.samples - done), 0, 0, false};
        const auto start = std::chrono::steady_clock::now();
        while (!span.finalize) {
            if (call_off.came()) {
                return call_off.status();
            }
            span.last_segment = std::min(max_path_length_, span.first_segment + SEGMENTS_PER_SUBMISSION);
            span.finalize = span.last_segment == max_path_length_;
            Status status = run_span(device, kernels, batch, span, counts);
            if (status.ok() && !span.finalize && entries(span.last_segment + 1, COUNTER_EXTENSION) == 0) {
                // All paths have ended early.
                span = {done, span.samples, max_path_length_, max_path_length_, true};
                status = run_span(device, kernels, batch, span, counts);
            }
            if (!status.ok()) {
                return status;
            }
            span.first_segment = span.last_segment;
        }
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        sample_ms_ = taken.count() / span.samples;
        done += span.samples;
    }
    counts.primary_rays += uint64_t{batch.path_count} * batch.samples;
    return Status::success();
}

uint32_t Wavefront::entries(uint32_t segment, uint32_t counter) const {
    const auto* counters = static_cast<const uint32_t*>(counters_copy_.mapped());
    return counters[COUNTER_SEGMENTS + segment * COUNTERS_PER_SEGMENT + counter];
}

Status Wavefront::run_span(const Device& device, const KernelSet& kernels, const BatchPass& batch, const Span& span,
                           WavefrontCounts& counts) {
    const Work work = [&](VkCommandBuffer commands) {
        for (uint32_t i = 0; i < span.samples; ++i) {
            record_sample(commands, kernels, batch, span, span.first_sample + i);
        }
    };
    return run_work(device, work, counts);
}

// Runs what `work` records and adds up rays and times.
Status Wavefront::run_work(const Device& device, const Work& work, WavefrontCounts& counts) {
    stamps_.clear();
    Status status = device.submit_and_wait([&](VkCommandBuffer commands) { record(commands, work); });
    if (status.ok()) {
        status = counters_copy_.invalidate();
    }
    if (!status.ok()) {
        return status;
    }
    const auto* counters = static_cast<const uint32_t*>(counters_copy_.mapped());
    counts.extension_rays += counters[COUNTER_EXTENSION_TOTAL];
    counts.shadow_rays += counters[COUNTER_SHADOW_TOTAL];
    return read_times(device, counts);
}

// Some kernels on their own, in this order; generate starts a sample.
Status Wavefront::run_kernels(const Device& device, const KernelSet& kernels, const Pass& pass,
                              std::initializer_list<Kernel> wanted, WavefrontCounts& counts) {
    const Work work = [&](VkCommandBuffer commands) {
        for (const Kernel kernel : wanted) {
            if (kernel == Kernel::generate) {
                clear_segments(commands);
            }
            kernel_barrier(commands);
            dispatch(commands, kernels, kernel, pass);
        }
    };
    return run_work(device, work, counts);
}

void Wavefront::record(VkCommandBuffer commands, const Work& work) {
    if (queries_) {
        vkCmdResetQueryPool(commands, queries_.get(), 0, MOST_STAMPS);
    }
    vkCmdFillBuffer(commands, counters_.handle(), 0, COUNTER_SEGMENTS * sizeof(uint32_t), 0);
    barrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT);
    stamp(commands, NO_KERNEL);
    work(commands);
    barrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_TRANSFER_READ_BIT);
    const VkBufferCopy copy{0, 0, counters_.size()};
    vkCmdCopyBuffer(commands, counters_.handle(), counters_copy_.handle(), 1, &copy);
    barrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
            VK_ACCESS_HOST_READ_BIT);
}

Pass Wavefront::pass_of(const BatchPass& batch, uint32_t sample) {
    Pass pass{};
    pass.sample_index = batch.first_sample + sample;
    pass.first_pixel = batch.first_pixel;
    pass.path_count = batch.path_count;
    pass.sample_scale = 1.0f / static_cast<float>(batch.samples_before + sample + 1);
    pass.first_in_sum = batch.samples_before + sample == 0 ? 1 : 0;
    return pass;
}

void Wavefront::clear_segments(VkCommandBuffer commands) {
    barrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_TRANSFER_WRITE_BIT);
    vkCmdFillBuffer(commands, counters_.handle(), COUNTER_SEGMENTS * sizeof(uint32_t), VK_WHOLE_SIZE, 0);
    barrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
}

void Wavefront::record_sample(VkCommandBuffer commands, const KernelSet& kernels, const BatchPass& batch,
                              const Span& span, uint32_t sample) {
    Pass pass = pass_of(batch, sample);
    if (span.first_segment == 0) {
        clear_segments(commands);
        dispatch(commands, kernels, Kernel::generate, pass);
        kernel_barrier(commands);
        dispatch(commands, kernels, Kernel::schedule, pass);
    }
    for (uint32_t segment = span.first_segment + 1; segment <= span.last_segment; ++segment) {
        pass.segment = segment;
        kernel_barrier(commands);
        dispatch(commands, kernels, Kernel::extend, pass);
        kernel_barrier(commands);
        dispatch(commands, kernels, Kernel::shade, pass);
        kernel_barrier(commands);
        dispatch(commands, kernels, Kernel::schedule, pass);
        kernel_barrier(commands);
        dispatch(commands, kernels, Kernel::connect, pass);
    }
    if (span.finalize) {
        kernel_barrier(commands);
        dispatch(commands, kernels, Kernel::finalize, pass);
    }
}

void Wavefront::dispatch(VkCommandBuffer commands, const KernelSet& kernels, Kernel kernel, const Pass& pass) {
    const VkDescriptorSet set = kernels.descriptor_set(pass.segment & 1u);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernels.pipeline(kernel));
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernels.layout(), 0, 1, &set, 0, nullptr);
    vkCmdPushConstants(commands, kernels.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(pass), &pass);
    switch (kernel) {
        case Kernel::generate:
        case Kernel::finalize:
        case Kernel::filter:
        case Kernel::reproject:
            vkCmdDispatch(commands, group_count(pass.path_count), 1, 1);
            break;
        case Kernel::schedule:
            vkCmdDispatch(commands, 1, 1, 1);
            break;
        case Kernel::extend:
        case Kernel::shade:
        case Kernel::guide:
            vkCmdDispatchIndirect(commands, arguments_.handle(), ARGUMENTS_EXTENSION * sizeof(uint32_t));
            break;
        case Kernel::connect:
            vkCmdDispatchIndirect(commands, arguments_.handle(), ARGUMENTS_SHADOW * sizeof(uint32_t));
            break;
    }
    stamp(commands, static_cast<uint32_t>(kernel));
}

void Wavefront::stamp(VkCommandBuffer commands, uint32_t kernel) {
    if (queries_ && stamps_.size() < MOST_STAMPS) {
        vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries_.get(),
                            static_cast<uint32_t>(stamps_.size()));
        stamps_.push_back(kernel);
    }
}

Status Wavefront::read_times(const Device& device, WavefrontCounts& counts) const {
    if (!queries_) {
        return Status::success();
    }
    std::vector<uint64_t> ticks(stamps_.size());
    const VkResult result = vkGetQueryPoolResults(
        device.handle(), queries_.get(), 0, static_cast<uint32_t>(ticks.size()), ticks.size() * sizeof(uint64_t),
        ticks.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    if (result != VK_SUCCESS) {
        return vulkan_error("read timestamps", result);
    }
    for (size_t i = 1; i < ticks.size(); ++i) {
        const uint64_t taken = (ticks[i] - ticks[i - 1]) & device.limits().timestamp_mask;
        counts.kernel_ms[stamps_[i]] += static_cast<double>(taken) * device.limits().timestamp_ns * 1e-6;
    }
    return Status::success();
}

}  // namespace source_core

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/device/buffer.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace source_core {

namespace {

constexpr uint64_t SMALLEST_BUFFER = 16;  // one row: an empty table can still be bound

Status over_budget(const std::string& name, uint64_t needed, const MemoryBudget& budget) {
    return Status::out_of_memory("the buffer '" + name + "' does not fit the budget of device memory",
                                 budget.used() + needed, budget.limit());
}

VkMemoryPropertyFlags required_memory(BufferPlace place) {
    switch (place) {
        case BufferPlace::device:
            return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
        case BufferPlace::upload:
            return VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        case BufferPlace::readback:
            return VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
    }
    return 0;
}

VkMemoryPropertyFlags preferred_memory(BufferPlace place) {
    const VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    return place == BufferPlace::readback ? cached : 0;
}

}  // namespace

Result<Buffer> Buffer::create(const Device& device, MemoryBudget& budget, const std::string& name, uint64_t size,
                              VkBufferUsageFlags usage, BufferPlace place) {
    Buffer buffer;
    buffer.size_ = std::max(size, SMALLEST_BUFFER);
    if (!budget.has_room(buffer.size_)) {
        return over_budget(name, buffer.size_, budget);
    }
    if (buffer.size_ > device.limits().buffer_size) {
        return Status::out_of_memory("the buffer '" + name + "' is larger than one allocation of " + device.name(),
                                     buffer.size_, device.limits().buffer_size);
    }
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = buffer.size_;
    info.usage = usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    VkBuffer handle = VK_NULL_HANDLE;
    VkResult result = vkCreateBuffer(device.handle(), &info, nullptr, &handle);
    if (result != VK_SUCCESS) {
        return vulkan_error("create the buffer '" + name + "'", result);
    }
    buffer.device_ = device.handle();
    buffer.buffer_ = {device.handle(), handle, vkDestroyBuffer};

    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device.handle(), handle, &needs);
    if (!budget.has_room(needs.size)) {
        return over_budget(name, needs.size, budget);
    }
    const int type = device.find_memory_type(needs.memoryTypeBits, required_memory(place), preferred_memory(place));
    if (type < 0) {
        return Status::error(StatusCode::internal, "no memory type fits the buffer '" + name + "'");
    }
    VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocation.pNext = (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0 ? &flags : nullptr;
    allocation.allocationSize = needs.size;
    allocation.memoryTypeIndex = static_cast<uint32_t>(type);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    result = vkAllocateMemory(device.handle(), &allocation, nullptr, &memory);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY) {
        return Status::out_of_memory(vulkan_error("allocate the buffer '" + name + "'", result).message,
                                     budget.used() + needs.size, budget.limit());
    }
    if (result != VK_SUCCESS) {
        return vulkan_error("allocate the buffer '" + name + "'", result);
    }
    buffer.memory_ = {device.handle(), memory, vkFreeMemory};
    buffer.budget_ = &budget;
    buffer.allocated_ = needs.size;
    budget.take(needs.size);

    result = vkBindBufferMemory(device.handle(), handle, memory, 0);
    if (result != VK_SUCCESS) {
        return vulkan_error("bind the buffer '" + name + "'", result);
    }
    if (place != BufferPlace::device) {
        result = vkMapMemory(device.handle(), memory, 0, VK_WHOLE_SIZE, 0, &buffer.mapped_);
        if (result != VK_SUCCESS) {
            return vulkan_error("map the buffer '" + name + "'", result);
        }
    }
    buffer.coherent_ = device.memory_is_coherent(static_cast<uint32_t>(type));
    return Result<Buffer>(std::move(buffer));
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    Buffer moved(std::move(other));
    swap(moved);
    return *this;
}

Buffer::~Buffer() {
    if (budget_ != nullptr) {
        budget_->give_back(allocated_);
    }
    buffer_ = {};  // before its memory
}

Status Buffer::invalidate() const {
    if (coherent_) {
        return Status::success();
    }
    VkMappedMemoryRange range{VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE};
    range.memory = memory_.get();
    range.size = VK_WHOLE_SIZE;
    const VkResult result = vkInvalidateMappedMemoryRanges(device_, 1, &range);
    return result == VK_SUCCESS ? Status::success() : vulkan_error("read mapped memory", result);
}

VkDeviceAddress Buffer::address() const {
    VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
    info.buffer = buffer_.get();
    return vkGetBufferDeviceAddress(device_, &info);
}

void Buffer::swap(Buffer& other) {
    std::swap(device_, other.device_);
    std::swap(budget_, other.budget_);
    std::swap(memory_, other.memory_);
    std::swap(buffer_, other.buffer_);
    std::swap(size_, other.size_);
    std::swap(allocated_, other.allocated_);
    std::swap(mapped_, other.mapped_);
    std::swap(coherent_, other.coherent_);
}

Result<Staging> Staging::create(const Device& device, MemoryBudget& budget) {
    Staging staging;
    Result<Buffer> upload =
        Buffer::create(device, budget, "staging", PIECE, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::upload);
    if (!upload.ok()) {
        return upload.status;
    }
    Result<Buffer> readback =
        Buffer::create(device, budget, "read-back", PIECE, VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::readback);
    if (!readback.ok()) {
        return readback.status;
    }
    staging.upload_ = std::move(*upload);
    staging.readback_ = std::move(*readback);
    return Result<Staging>(std::move(staging));
}

Status Staging::upload(const Device& device, std::span<const Part> parts) const {
    struct Copy {
        VkBuffer target;
        VkBufferCopy region;
    };
    std::vector<Copy> copies;
    uint64_t filled = 0;
    const auto send = [&] {
        Status status = device.submit_and_wait([&](VkCommandBuffer commands) {
            // A part may lie over one before it: copies have no order of their own.
            VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
            barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
            barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
            for (const Copy& copy : copies) {
                vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1,
                                     &barrier, 0, nullptr, 0, nullptr);
                vkCmdCopyBuffer(commands, upload_.handle(), copy.target, 1, &copy.region);
            }
        });
        copies.clear();
        filled = 0;
        return status;
    };
    for (const Part& part : parts) {
        for (uint64_t done = 0; done < part.bytes.size();) {
            const uint64_t count = std::min(PIECE - filled, part.bytes.size() - done);
            std::memcpy(static_cast<std::byte*>(upload_.mapped()) + filled, part.bytes.data() + done, count);
            copies.push_back({part.target->handle(), {filled, part.at + done, count}});
            done += count;
            filled += count;
            if (Status status = filled == PIECE ? send() : Status::success(); !status.ok()) {
                return status;
            }
        }
    }
    return copies.empty() ? Status::success() : send();
}

Status Staging::upload(const Device& device, const Buffer& target, uint64_t size,
                       const std::function<void(uint64_t, std::span<std::byte>)>& produce) const {
    for (uint64_t offset = 0; offset < size; offset += PIECE) {
        const uint64_t count = std::min(PIECE, size - offset);
        produce(offset, {static_cast<std::byte*>(upload_.mapped()), count});
        Status status = device.submit_and_wait([&](VkCommandBuffer commands) {
            const VkBufferCopy copy{0, offset, count};
            vkCmdCopyBuffer(commands, upload_.handle(), target.handle(), 1, &copy);
        });
        if (!status.ok()) {
            return status;
        }
    }
    return Status::success();
}

Status Staging::download(const Device& device, const Buffer& source, std::span<std::byte> data) const {
    for (uint64_t offset = 0; offset < data.size(); offset += PIECE) {
        const uint64_t count = std::min<uint64_t>(PIECE, data.size() - offset);
        Status status = device.submit_and_wait([&](VkCommandBuffer commands) {
            const VkBufferCopy copy{offset, 0, count};
            vkCmdCopyBuffer(commands, source.handle(), readback_.handle(), 1, &copy);
            VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
            barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
            barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
            vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier,
                                 0, nullptr, 0, nullptr);
        });
        if (status.ok()) {
            status = readback_.invalidate();
        }
        if (!status.ok()) {
            return status;
        }
        std::memcpy(data.data() + offset, readback_.mapped(), count);
    }
    return Status::success();
}

}  // namespace source_core

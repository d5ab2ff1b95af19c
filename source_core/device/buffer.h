// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "source_core/device/device.h"

namespace source_core {

/// Counts the bytes of device memory against a limit. Every allocation of the core goes through one budget.
class MemoryBudget {
public:
    explicit MemoryBudget(uint64_t limit) : limit_(limit) {}

    uint64_t limit() const { return limit_; }
    uint64_t used() const { return used_; }
    bool has_room(uint64_t bytes) const { return bytes <= limit_ - used_; }
    void take(uint64_t bytes) { used_ += bytes; }
    void give_back(uint64_t bytes) { used_ -= bytes; }

private:
    uint64_t limit_;
    uint64_t used_ = 0;
};

enum class BufferPlace {
    device,    ///< device-local; filled and read through a staging buffer
    upload,    ///< mapped, written by the host
    readback,  ///< mapped, read by the host
};

/// A buffer with memory of its own, counted by a budget that outlives it. Mapped for its whole life where the host
/// can reach it.
class Buffer {
public:
    Buffer() = default;

    /// `size` bytes (at least 16 are made). Fails with out_of_memory: over the budget, or more than one buffer of the
    /// device can hold.
    static Result<Buffer> create(const Device& device, MemoryBudget& budget, const std::string& name, uint64_t size,
                                 VkBufferUsageFlags usage, BufferPlace place);

    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer&& other) noexcept;
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer();

    VkBuffer handle() const { return buffer_.get(); }
    uint64_t size() const { return size_; }
    explicit operator bool() const { return static_cast<bool>(buffer_); }
    void* mapped() const { return mapped_; }
    /// Makes what the device wrote visible in mapped().
    Status invalidate() const;
    /// Needs the usage VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT.
    VkDeviceAddress address() const;

private:
    void swap(Buffer& other);

    VkDevice device_ = VK_NULL_HANDLE;
    MemoryBudget* budget_ = nullptr;
    Handle<VkDeviceMemory> memory_;
    Handle<VkBuffer> buffer_;
    uint64_t size_ = 0;
    uint64_t allocated_ = 0;
    void* mapped_ = nullptr;
    bool coherent_ = true;
};

/// Copies between host memory and device buffers in pieces through two mapped buffers of a fixed size.
class Staging {
public:
    static constexpr uint64_t PIECE = 4ull << 20;

    static Result<Staging> create(const Device& device, MemoryBudget& budget);

    /// Bytes for a buffer from byte `at` on.
    struct Part {
        const Buffer* target = nullptr;
        uint64_t at = 0;
        std::span<const std::byte> bytes;
    };
    /// Several parts, as many as a piece holds with one wait for the device.
    Status upload(const Device& device, std::span<const Part> parts) const;
    /// Fills the target piece by piece: `produce(offset, bytes)` writes the bytes at that offset of the table.
    Status upload(const Device& device, const Buffer& target, uint64_t size,
                  const std::function<void(uint64_t, std::span<std::byte>)>& produce) const;
    Status download(const Device& device, const Buffer& source, std::span<std::byte> data) const;

private:
    Staging() = default;

    Buffer upload_;
    Buffer readback_;
};

}  // namespace source_core

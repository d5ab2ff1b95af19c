// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <functional>
#include <string>

#include "source_core/device/exact_arithmetic.h"
#include "source_core/device/handle.h"
#include "source_core/device/instance.h"

namespace source_core {

/// What the core needs to know of a device's limits, in the units of the specification.
struct DeviceLimits {
    uint64_t texel_buffer_elements = 0;
    uint64_t storage_buffer_range = 0;
    uint64_t buffer_size = 0;      ///< of one buffer and of one allocation
    uint64_t local_heap_size = 0;  ///< of the largest device-local heap
    uint32_t work_group_count = 0;
    uint64_t storage_alignment = 0;
    double timestamp_ns = 0.0;  ///< per tick; 0: no timestamps
    uint64_t timestamp_mask = 0;
    bool device_address = false;
    ExactArithmetic exact;  ///< what exact mode needs here to give the bits of a CPU
};

/// One logical device with one compute queue and what it takes to submit work and wait for it.
class Device {
public:
    /// The best device that can run the core: discrete before integrated before virtual before software. Fails with
    /// no_device and one reason per device looked at.
    static Result<Device> create(const Instance& instance);

    /// Whether `create` would take a software device, for want of a GPU.
    static bool only_software(const Instance& instance);

    Device(Device&& other) noexcept;
    Device& operator=(Device&&) = delete;
    ~Device();

    VkDevice handle() const { return device_; }
    const DeviceLimits& limits() const { return limits_; }
    const std::string& name() const { return name_; }

    /// Index of a memory type among `type_bits` with all of `required`, better one with `preferred` too; -1: none.
    int find_memory_type(uint32_t type_bits, VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred) const;
    bool memory_is_coherent(uint32_t type) const;

    /// Records commands, submits them and waits until they are done. Fails with device_lost where the device is.
    Status submit_and_wait(const std::function<void(VkCommandBuffer)>& record) const;

private:
    Device() = default;
    Status open(VkPhysicalDevice physical);

    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkPhysicalDeviceMemoryProperties memory_{};
    DeviceLimits limits_;
    std::string name_;
    Handle<VkCommandPool> pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    Handle<VkFence> fence_;
};

}  // namespace source_core

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/device/device.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace source_core {

namespace {

constexpr uint32_t NEEDED_STORAGE_BUFFERS = 29;  // path state, and all tables where they are bound so
constexpr uint32_t NEEDED_TEXEL_BUFFERS = 16;
constexpr uint32_t NO_FAMILY = 0xFFFFFFFFu;

struct Candidate {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    std::string name;
    std::string refusal;  // empty: usable
    int rank = 0;
};

uint32_t compute_family(VkPhysicalDevice physical) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    for (uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0 && families[i].queueCount > 0) {
            return i;
        }
    }
    return NO_FAMILY;
}

bool reads_texels(VkPhysicalDevice physical, VkFormat format) {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(physical, format, &properties);
    return (properties.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT) != 0;
}

std::string refusal_of(VkPhysicalDevice physical, const VkPhysicalDeviceProperties& properties) {
    if (properties.apiVersion < VK_API_VERSION_1_2) {
        return "has Vulkan " + std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) + "." +
               std::to_string(VK_API_VERSION_MINOR(properties.apiVersion)) + ", 1.2 is needed";
    }
    if (compute_family(physical) == NO_FAMILY) {
        return "has no compute queue";
    }
    const VkPhysicalDeviceLimits& limits = properties.limits;
    if (limits.maxPerStageDescriptorStorageBuffers < NEEDED_STORAGE_BUFFERS) {
        return "binds " + std::to_string(limits.maxPerStageDescriptorStorageBuffers) + " storage buffers, " +
               std::to_string(NEEDED_STORAGE_BUFFERS) + " are needed";
    }
    if (limits.maxPerStageDescriptorSampledImages < NEEDED_TEXEL_BUFFERS) {
        return "binds " + std::to_string(limits.maxPerStageDescriptorSampledImages) + " texel buffers, " +
               std::to_string(NEEDED_TEXEL_BUFFERS) + " are needed";
    }
    for (const VkFormat format : {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32_UINT}) {
        if (!reads_texels(physical, format)) {
            return "cannot read 32-bit texel buffers";
        }
    }
    return {};
}

int rank_of(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return 4;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return 3;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return 2;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return 1;
        default:
            return 0;
    }
}

std::vector<Candidate> look_at_devices(VkInstance instance) {
    uint32_t count = 0;
    if (vkEnumeratePhysicalDevices(instance, &count, nullptr) != VK_SUCCESS) {
        return {};
    }
    std::vector<VkPhysicalDevice> devices(count);
    if (vkEnumeratePhysicalDevices(instance, &count, devices.data()) < 0) {
        return {};
    }
    devices.resize(count);
    std::vector<Candidate> candidates;
    for (const VkPhysicalDevice physical : devices) {
        VkPhysicalDeviceProperties properties{};
        vkGetPhysicalDeviceProperties(physical, &properties);
        candidates.push_back(
            {physical, properties.deviceName, refusal_of(physical, properties), rank_of(properties.deviceType)});
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.rank > b.rank; });
    return candidates;
}

uint64_t largest_local_heap(const VkPhysicalDeviceMemoryProperties& memory) {
    uint64_t size = 0;
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0) {
            size = std::max<uint64_t>(size, memory.memoryHeaps[i].size);
        }
    }
    return size;
}

// llvmpipe, which is what lavapipe runs on, divides as the CPU under it does.
ExactArithmetic exact_arithmetic_of(const VkPhysicalDeviceVulkan12Properties& properties) {
    if (properties.driverID == VK_DRIVER_ID_MESA_LLVMPIPE) {
        return {};
    }
    return {.spelled_out = true,
            .keeps_denormals = properties.shaderDenormPreserveFloat32 == VK_TRUE,
            .keeps_zeros_and_nan = properties.shaderSignedZeroInfNanPreserveFloat32 == VK_TRUE,
            .rounds_to_nearest = properties.shaderRoundingModeRTEFloat32 == VK_TRUE};
}

DeviceLimits read_limits(VkPhysicalDevice physical, uint32_t family, const VkPhysicalDeviceMemoryProperties& memory) {
    VkPhysicalDeviceMaintenance3Properties allocation{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceVulkan12Properties properties12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES};
    allocation.pNext = &properties12;
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &allocation;
    vkGetPhysicalDeviceProperties2(physical, &properties);
    VkPhysicalDeviceVulkan12Features features12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    features.pNext = &features12;
    vkGetPhysicalDeviceFeatures2(physical, &features);

    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    const uint32_t bits = families[family].timestampValidBits;

    DeviceLimits limits;
    limits.texel_buffer_elements = properties.properties.limits.maxTexelBufferElements;
    limits.storage_buffer_range = properties.properties.limits.maxStorageBufferRange;
    limits.buffer_size = allocation.maxMemoryAllocationSize;
    limits.local_heap_size = largest_local_heap(memory);
    limits.work_group_count = properties.properties.limits.maxComputeWorkGroupCount[0];
    limits.storage_alignment = properties.properties.limits.minStorageBufferOffsetAlignment;
    limits.timestamp_ns = bits == 0 ? 0.0 : static_cast<double>(properties.properties.limits.timestampPeriod);
    limits.timestamp_mask = bits >= 64 ? ~0ull : (1ull << bits) - 1;
    limits.device_address = features12.bufferDeviceAddress == VK_TRUE;
    limits.exact = exact_arithmetic_of(properties12);
    return limits;
}

}  // namespace

Result<Device> Device::create(const Instance& instance) {
    std::string reasons;
    for (const Candidate& candidate : look_at_devices(instance.handle())) {
        std::string reason = candidate.refusal;
        if (reason.empty()) {
            Device device;
            device.name_ = candidate.name;
            const Status status = device.open(candidate.physical);
            if (status.ok()) {
                return Result<Device>(std::move(device));
            }
            reason = status.message;
        }
        reasons += (reasons.empty() ? "" : "; ") + candidate.name + ": " + reason;
    }
    if (reasons.empty()) {
        reasons = "the Vulkan drivers on this machine offer no device; install one (Debian: mesa-vulkan-drivers)";
    }
    return Status::error(StatusCode::no_device, reasons);
}

bool Device::only_software(const Instance& instance) {
    const std::vector<Candidate> candidates = look_at_devices(instance.handle());
    const auto best = std::find_if(candidates.begin(), candidates.end(),
                                   [](const Candidate& candidate) { return candidate.refusal.empty(); });
    return best != candidates.end() && best->rank <= rank_of(VK_PHYSICAL_DEVICE_TYPE_CPU);
}

Status Device::open(VkPhysicalDevice physical) {
    const uint32_t family = compute_family(physical);
    vkGetPhysicalDeviceMemoryProperties(physical, &memory_);
    limits_ = read_limits(physical, family, memory_);

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDeviceVulkan12Features features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    features.bufferDeviceAddress = limits_.device_address ? VK_TRUE : VK_FALSE;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    VkResult result = vkCreateDevice(physical, &info, nullptr, &device_);
    if (result != VK_SUCCESS) {
        device_ = VK_NULL_HANDLE;
        return vulkan_error("open the device", result);
    }
    vkGetDeviceQueue(device_, family, 0, &queue_);

    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = family;
    VkCommandPool pool_handle = VK_NULL_HANDLE;
    result = vkCreateCommandPool(device_, &pool, nullptr, &pool_handle);
    if (result != VK_SUCCESS) {
        return vulkan_error("create a command pool", result);
    }
    pool_ = {device_, pool_handle, vkDestroyCommandPool};

    VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    commands.commandPool = pool_handle;
    commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands.commandBufferCount = 1;
    result = vkAllocateCommandBuffers(device_, &commands, &commands_);
    if (result != VK_SUCCESS) {
        return vulkan_error("allocate a command buffer", result);
    }
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence_handle = VK_NULL_HANDLE;
    result = vkCreateFence(device_, &fence, nullptr, &fence_handle);
    if (result != VK_SUCCESS) {
        return vulkan_error("create a fence", result);
    }
    fence_ = {device_, fence_handle, vkDestroyFence};
    return Status::success();
}

Device::Device(Device&& other) noexcept
    : device_(std::exchange(other.device_, VK_NULL_HANDLE)),
      queue_(other.queue_),
      memory_(other.memory_),
      limits_(other.limits_),
      name_(std::move(other.name_)),
      pool_(std::move(other.pool_)),
      commands_(other.commands_),
      fence_(std::move(other.fence_)) {}

Device::~Device() {
    if (device_ != VK_NULL_HANDLE) {
        vkDeviceWaitIdle(device_);
        fence_ = {};
        pool_ = {};
        vkDestroyDevice(device_, nullptr);
    }
}

int Device::find_memory_type(uint32_t type_bits, VkMemoryPropertyFlags required,
                             VkMemoryPropertyFlags preferred) const {
    for (const VkMemoryPropertyFlags wanted : {required | preferred, required}) {
        for (uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
            const bool allowed = (type_bits & (1u << i)) != 0;
            if (allowed && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted) {
                return static_cast<int>(i);
            }
        }
    }
    return -1;
}

bool Device::memory_is_coherent(uint32_t type) const {
    return (memory_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) != 0;
}

Status Device::submit_and_wait(const std::function<void(VkCommandBuffer)>& record) const {
    VkResult result = vkResetCommandPool(device_, pool_.get(), 0);
    if (result != VK_SUCCESS) {
        return vulkan_error("reset the command pool", result);
    }
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    result = vkBeginCommandBuffer(commands_, &begin);
    if (result != VK_SUCCESS) {
        return vulkan_error("begin recording", result);
    }
    record(commands_);
    result = vkEndCommandBuffer(commands_);
    if (result != VK_SUCCESS) {
        return vulkan_error("end recording", result);
    }
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    result = vkQueueSubmit(queue_, 1, &submit, fence_.get());
    if (result != VK_SUCCESS) {
        return vulkan_error("submit work", result);
    }
    const VkFence fence = fence_.get();
    result = vkWaitForFences(device_, 1, &fence, VK_TRUE, UINT64_MAX);
    if (result != VK_SUCCESS) {
        return vulkan_error("wait for the device", result);
    }
    result = vkResetFences(device_, 1, &fence);
    return result == VK_SUCCESS ? Status::success() : vulkan_error("reset a fence", result);
}

}  // namespace source_core

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <utility>

namespace source_core {

/// Owns one Vulkan object that a VkDevice made; destroys it once. Empty after a move.
template <class T>
class Handle {
public:
    using Destroy = void(VKAPI_PTR*)(VkDevice, T, const VkAllocationCallbacks*);

    Handle() = default;
    Handle(VkDevice device, T object, Destroy destroy) : device_(device), object_(object), destroy_(destroy) {}
    Handle(Handle&& other) noexcept { swap(other); }
    Handle& operator=(Handle&& other) noexcept {
        Handle moved(std::move(other));
        swap(moved);
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (object_ != VK_NULL_HANDLE) {
            destroy_(device_, object_, nullptr);
        }
    }

    T get() const { return object_; }
    explicit operator bool() const { return object_ != VK_NULL_HANDLE; }

private:
    void swap(Handle& other) {
        std::swap(device_, other.device_);
        std::swap(object_, other.object_);
        std::swap(destroy_, other.destroy_);
    }

    VkDevice device_ = VK_NULL_HANDLE;
    T object_ = VK_NULL_HANDLE;
    Destroy destroy_ = nullptr;
};

}  // namespace source_core

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "source_core/device/vulkan_status.h"

namespace source_core {

/// What the validation layers said. Filled from inside Vulkan calls, on any thread.
class ValidationLog {
public:
    void add(std::string message);
    /// Takes the messages out as one error, or success if there was none.
    Status take();

private:
    std::mutex mutex_;
    std::vector<std::string> messages_;
};

/// Which checks of the validation layers to run under.
enum class Validation {
    none,
    host,      ///< core and synchronization checks
    assisted,  ///< these and GPU-assisted checks of buffer accesses, for which kernels take far longer to compile
};

/// The connection to the Vulkan loader, with or without the validation layers.
class Instance {
public:
    /// Fails with no_device where there is no loader, no driver, or no validation layer though asked for.
    static Result<Instance> create(Validation validation);

    Instance(Instance&& other) noexcept;
    Instance& operator=(Instance&&) = delete;
    ~Instance();

    VkInstance handle() const { return instance_; }
    /// Success unless the validation layers complained since the last call.
    Status validation_status() { return log_->take(); }

private:
    Instance() : log_(std::make_unique<ValidationLog>()) {}

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::unique_ptr<ValidationLog> log_;
};

}  // namespace source_core

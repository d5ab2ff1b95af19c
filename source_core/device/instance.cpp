// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/device/instance.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace source_core {

namespace {

constexpr const char* VALIDATION_LAYER = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    static_cast<ValidationLog*>(user)->add(data->pMessage != nullptr ? data->pMessage : "(no text)");
    return VK_FALSE;
}

// Whether this was the first instance to end, which then stays: the driver goes with the last instance, and NVIDIA's
// (580) can't be loaded again after some forty times, so that a process that opens core after core would run dry.
bool kept_for_its_driver(VkInstance instance) {
    static std::atomic<VkInstance> kept = VK_NULL_HANDLE;
    VkInstance none = VK_NULL_HANDLE;
    return kept.compare_exchange_strong(none, instance);
}

bool validation_layer_present() {
    uint32_t count = 0;
    if (vkEnumerateInstanceLayerProperties(&count, nullptr) != VK_SUCCESS) {
        return false;
    }
    std::vector<VkLayerProperties> layers(count);
    if (vkEnumerateInstanceLayerProperties(&count, layers.data()) < 0) {
        return false;
    }
    return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, VALIDATION_LAYER) == 0;
    });
}

}  // namespace

void ValidationLog::add(std::string message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.push_back(std::move(message));
}

Status ValidationLog::take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (messages_.empty()) {
        return Status::success();
    }
    std::string text = "the validation layers report " + std::to_string(messages_.size()) + " message(s): ";
    text += messages_.front();
    messages_.clear();
    return Status::error(StatusCode::internal, std::move(text));
}

Result<Instance> Instance::create(Validation validation) {
    const bool validate = validation != Validation::none;
    if (validate && !validation_layer_present()) {
        return Status::error(StatusCode::no_device, std::string("the Vulkan layer ") + VALIDATION_LAYER +
                                                        " is not installed (Debian: vulkan-validationlayers)");
    }
    Instance instance;
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "pathtracer";
    application.apiVersion = VK_API_VERSION_1_2;

    const VkValidationFeatureEnableEXT enables[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,
                                                    VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT};
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = validation == Validation::assisted ? 2 : 1;
    features.pEnabledValidationFeatures = enables;

    VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = on_message;
    messenger.pUserData = instance.log_.get();
    messenger.pNext = &features;

    const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    if (validate) {
        info.pNext = &messenger;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &VALIDATION_LAYER;
        info.enabledExtensionCount = 2;
        info.ppEnabledExtensionNames = extensions;
    }
    const VkResult result = vkCreateInstance(&info, nullptr, &instance.instance_);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        instance.instance_ = VK_NULL_HANDLE;
        return Status::error(StatusCode::no_device,
                             "no Vulkan driver was found; install one (Debian: mesa-vulkan-drivers) and check "
                             "VK_DRIVER_FILES and VK_ICD_FILENAMES where they are set");
    }
    if (result != VK_SUCCESS) {
        instance.instance_ = VK_NULL_HANDLE;
        return Status::error(StatusCode::no_device, vulkan_error("open Vulkan", result).message);
    }
    if (validate) {
        messenger.pNext = nullptr;
        const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance.instance_, "vkCreateDebugUtilsMessengerEXT"));
        if (create_messenger == nullptr ||
            create_messenger(instance.instance_, &messenger, nullptr, &instance.messenger_) != VK_SUCCESS) {
            return Status::error(StatusCode::internal, "failed to listen to the validation layers");
        }
    }
    return Result<Instance>(std::move(instance));
}

Instance::Instance(Instance&& other) noexcept
    : instance_(std::exchange(other.instance_, VK_NULL_HANDLE)),
      messenger_(std::exchange(other.messenger_, VK_NULL_HANDLE)),
      log_(std::move(other.log_)) {}

Instance::~Instance() {
    const bool watched = messenger_ != VK_NULL_HANDLE;
    if (watched) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE && (watched || !kept_for_its_driver(instance_))) {
        vkDestroyInstance(instance_, nullptr);
    }
}

}  // namespace source_core

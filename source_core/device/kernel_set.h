// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <compare>
#include <map>
#include <string>
#include <vector>

#include "source_core/device/device.h"
#include "source_core/device/exact_arithmetic.h"
#include "source_core/kernels/bindings.h"

namespace source_core {

enum class Kernel : uint32_t { generate, extend, shade, connect, finalize, schedule, guide, filter, reproject };
constexpr uint32_t KERNEL_COUNT = 9;
constexpr uint32_t WAVEFRONT_KERNELS = 6;  // the first ones; the others are compiled where a filter asks for them
constexpr uint32_t WORK_GROUP_SIZE = 32;

/// Name of a kernel's file without its suffix.
const char* kernel_name(Kernel kernel);

/// How kernels reach a scene table; see buffers.glsl.
enum class TableAccess : uint8_t { texels, storage, address };

/// What kernels are compiled for.
struct KernelVariant {
    uint32_t features = 0;
    std::array<TableAccess, TABLE_COUNT> tables{};
    ExactArithmetic arithmetic;

    auto operator<=>(const KernelVariant&) const = default;

    /// Text that comes before a kernel's source.
    std::string preamble() const;
};

const char* table_name(uint32_t table);

/// The type of each binding of set 0 under a variant.
VkDescriptorType descriptor_type(uint32_t binding, const KernelVariant& variant);

/// All kernels compiled for one variant, with the layout that they share and two descriptor sets: in set 1 the roles
/// of the two queues are exchanged.
class KernelSet {
public:
    /// Fails with internal where a kernel does not compile.
    static Result<KernelSet> create(const Device& device, const std::map<std::string, std::string>& files,
                                    const KernelVariant& variant);

    /// Compiles one kernel from `files` for this variant and layout. May be called from any thread. Fails with internal
    /// where it does not compile.
    Result<Handle<VkPipeline>> compile(const Device& device, const std::map<std::string, std::string>& files,
                                       Kernel kernel) const;
    /// Puts what `compile` made in the place of the kernel that was there, which must not be at work.
    void replace(Kernel kernel, Handle<VkPipeline> pipeline) {
        pipelines_[static_cast<uint32_t>(kernel)] = std::move(pipeline);
    }
    /// Both in one.
    Status add(const Device& device, const std::map<std::string, std::string>& files, Kernel kernel);

    const KernelVariant& variant() const { return variant_; }
    /// Whether it has been compiled: those that only a filter runs are when one is asked for.
    bool has(Kernel kernel) const { return static_cast<bool>(pipelines_[static_cast<uint32_t>(kernel)]); }

    VkPipeline pipeline(Kernel kernel) const { return pipelines_[static_cast<uint32_t>(kernel)].get(); }
    VkPipelineLayout layout() const { return pipeline_layout_.get(); }
    VkDescriptorSet descriptor_set(uint32_t parity) const { return sets_[parity]; }

private:
    explicit KernelSet(const KernelVariant& variant) : variant_(variant) {}
    Status create_layout(const Device& device);
    Status create_sets(const Device& device);

    KernelVariant variant_;
    Handle<VkDescriptorSetLayout> set_layout_;
    Handle<VkPipelineLayout> pipeline_layout_;
    Handle<VkDescriptorPool> pool_;
    std::array<VkDescriptorSet, 2> sets_{};
    std::array<Handle<VkPipeline>, KERNEL_COUNT> pipelines_;
};

}  // namespace source_core

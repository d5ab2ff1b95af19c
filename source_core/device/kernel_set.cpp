// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/device/kernel_set.h"

#include "source_core/device/kernel_compiler.h"

namespace source_core {

namespace {

constexpr const char* KERNEL_NAMES[KERNEL_COUNT] = {"generate", "extend", "shade",  "connect",  "finalize",
                                                    "schedule", "guide",  "filter", "reproject"};
constexpr const char* TABLE_NAMES[TABLE_COUNT] = {
    "nodes",  "triangles", "mesh_triangles", "vertices",   "instances", "materials",   "texture_slots", "textures",
    "texels", "lights",    "light_table",    "sky_texels", "sky_table", "lobe_energy", "coincident"};
constexpr const char* ACCESS_NAMES[] = {"VIA_TEXELS", "VIA_STORAGE", "VIA_ADDRESS"};

}  // namespace

const char* kernel_name(Kernel kernel) { return KERNEL_NAMES[static_cast<uint32_t>(kernel)]; }

const char* table_name(uint32_t table) { return TABLE_NAMES[table]; }

std::string KernelVariant::preamble() const {
    std::string text =
        "#extension GL_EXT_buffer_reference : enable\n#extension GL_EXT_buffer_reference_uvec2 : enable\n";
    text += "#define WORK_GROUP_SIZE " + std::to_string(WORK_GROUP_SIZE) + "u\n";
    text += "#define FEATURES " + std::to_string(features) + "u\n";
    text += "#define has_feature(feature) ((FEATURES & (feature)) != 0u)\n";
    for (uint32_t table = 0; table < TABLE_COUNT; ++table) {
        text += std::string("#define TABLE_") + TABLE_NAMES[table] + " " +
                ACCESS_NAMES[static_cast<uint32_t>(tables[table])] + "\n";
    }
    return text;
}

VkDescriptorType descriptor_type(uint32_t binding, const KernelVariant& variant) {
    if (binding < TABLE_COUNT) {
        return variant.tables[binding] == TableAccess::texels ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER
                                                              : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
    const bool uniform = binding == BINDING_SETTINGS || binding == BINDING_ADDRESSES;
    return uniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

Result<KernelSet> KernelSet::create(const Device& device, const std::map<std::string, std::string>& files,
                                    const KernelVariant& variant) {
    KernelSet set(variant);
    Status status = set.create_layout(device);
    if (status.ok()) {
        status = set.create_sets(device);
    }
    for (uint32_t i = 0; i < WAVEFRONT_KERNELS && status.ok(); ++i) {
        status = set.add(device, files, static_cast<Kernel>(i));
    }
    if (!status.ok()) {
        return status;
    }
    return Result<KernelSet>(std::move(set));
}

Status KernelSet::add(const Device& device, const std::map<std::string, std::string>& files, Kernel kernel) {
    Result<Handle<VkPipeline>> pipeline = compile(device, files, kernel);
    if (pipeline.ok()) {
        replace(kernel, std::move(*pipeline));
    }
    return pipeline.status;
}

Status KernelSet::create_layout(const Device& device) {
    std::array<VkDescriptorSetLayoutBinding, BINDING_COUNT> bindings{};
    for (uint32_t i = 0; i < BINDING_COUNT; ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = descriptor_type(i, variant_);
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    }
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = BINDING_COUNT;
    info.pBindings = bindings.data();
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkResult result = vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &set_layout);
    if (result != VK_SUCCESS) {
        return vulkan_error("create a descriptor set layout", result);
    }
    set_layout_ = {device.handle(), set_layout, vkDestroyDescriptorSetLayout};

    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(Pass)};
    VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &range;
    VkPipelineLayout pipeline_layout = VK_NULL_HANDLE;
    result = vkCreatePipelineLayout(device.handle(), &layout, nullptr, &pipeline_layout);
    if (result != VK_SUCCESS) {
        return vulkan_error("create a pipeline layout", result);
    }
    pipeline_layout_ = {device.handle(), pipeline_layout, vkDestroyPipelineLayout};
    return Status::success();
}

Status KernelSet::create_sets(const Device& device) {
    uint32_t texels = 0;
    uint32_t storages = 0;
    for (uint32_t i = 0; i < BINDING_COUNT; ++i) {
        const VkDescriptorType type = descriptor_type(i, variant_);
        texels += type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER ? 2 : 0;
        storages += type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ? 2 : 0;
    }
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 4},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, storages},
                                          {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, texels}};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = 2;
    info.poolSizeCount = texels == 0 ? 2 : 3;
    info.pPoolSizes = sizes;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkResult result = vkCreateDescriptorPool(device.handle(), &info, nullptr, &pool);
    if (result != VK_SUCCESS) {
        return vulkan_error("create a descriptor pool", result);
    }
    pool_ = {device.handle(), pool, vkDestroyDescriptorPool};

    const VkDescriptorSetLayout layouts[] = {set_layout_.get(), set_layout_.get()};
    VkDescriptorSetAllocateInfo allocation{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocation.descriptorPool = pool;
    allocation.descriptorSetCount = 2;
    allocation.pSetLayouts = layouts;
    result = vkAllocateDescriptorSets(device.handle(), &allocation, sets_.data());
    return result == VK_SUCCESS ? Status::success() : vulkan_error("allocate descriptor sets", result);
}

Result<Handle<VkPipeline>> KernelSet::compile(const Device& device, const std::map<std::string, std::string>& files,
                                              Kernel kernel) const {
    const Result<std::vector<uint32_t>> compiled =
        compile_kernel(files, std::string(kernel_name(kernel)) + ".comp", variant_.preamble(), variant_.arithmetic);
    if (!compiled.ok()) {
        return compiled.status;
    }
    const std::vector<uint32_t>& words = *compiled;
    const std::string what = std::string("create the pipeline '") + kernel_name(kernel) + "'";
    VkShaderModuleCreateInfo module_info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    module_info.codeSize = words.size() * sizeof(uint32_t);
    module_info.pCode = words.data();
    VkShaderModule module_handle = VK_NULL_HANDLE;
    VkResult result = vkCreateShaderModule(device.handle(), &module_info, nullptr, &module_handle);
    if (result != VK_SUCCESS) {
        return vulkan_error(what, result);
    }
    const Handle<VkShaderModule> shader(device.handle(), module_handle, vkDestroyShaderModule);

    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module_handle;
    info.stage.pName = "main";
    info.layout = pipeline_layout_.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    result = vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
    if (result != VK_SUCCESS) {
        return vulkan_error(what, result);
    }
    return Handle<VkPipeline>(device.handle(), pipeline, vkDestroyPipeline);
}

}  // namespace source_core

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/scene_buffers.h"

#include <algorithm>
#include <string>

namespace source_core {

namespace {

constexpr uint64_t SMALLEST_TABLE = 256;  // 16 rows: more than any record has

uint64_t row_bytes(uint32_t table) { return table_format(table) == VK_FORMAT_R32_UINT ? 4 : 16; }

VkBufferUsageFlags usage_of(TableAccess access) {
    switch (access) {
        case TableAccess::texels:
            return VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
        case TableAccess::storage:
            return VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        case TableAccess::address:
            return VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    }
    return 0;
}

}  // namespace

VkFormat table_format(uint32_t table) {
    switch (table) {
        case BINDING_MESH_TRIANGLES:
        case BINDING_TEXTURES:
        case BINDING_COINCIDENT:
            return VK_FORMAT_R32G32B32A32_UINT;
        case BINDING_TEXELS:
            return VK_FORMAT_R32_UINT;
        default:
            return VK_FORMAT_R32G32B32A32_SFLOAT;
    }
}

Result<TableAccess> choose_access(const DeviceLimits& limits, uint32_t table, uint64_t bytes) {
    const uint64_t size = table_bytes(bytes);
    if (size / row_bytes(table) <= limits.texel_buffer_elements) {
        return TableAccess::texels;
    }
    if (size <= limits.storage_buffer_range) {
        return TableAccess::storage;
    }
    if (limits.device_address) {
        return TableAccess::address;
    }
    return Status::out_of_memory(
        std::string("the table '") + table_name(table) + "' is larger than any buffer binding", size,
        std::max(limits.texel_buffer_elements * row_bytes(table), limits.storage_buffer_range));
}

uint64_t table_bytes(uint64_t bytes) { return std::max(bytes, SMALLEST_TABLE); }

Status SceneBuffers::replace(const Device& device, MemoryBudget& budget, const Staging& staging, uint32_t table,
                             std::span<const std::byte> rows, uint64_t bytes, TableAccess access) {
    views_[table] = {};
    buffers_[table] = {};
    const uint64_t size = table_bytes(bytes);
    Result<Buffer> buffer = Buffer::create(
        device, budget, table_name(table), size,
        usage_of(access) | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::device);
    if (!buffer.ok()) {
        return buffer.status;
    }
    Status status = staging.upload(device, *buffer, size, [rows](uint64_t offset, std::span<std::byte> piece) {
        const auto present = rows.subspan(std::min<uint64_t>(offset, rows.size()));
        const uint64_t count = std::min(piece.size(), present.size());
        std::copy_n(present.begin(), count, piece.begin());
        std::fill(piece.begin() + static_cast<std::ptrdiff_t>(count), piece.end(), std::byte{0});
    });
    if (!status.ok()) {
        return status;
    }
    if (access == TableAccess::texels) {
        VkBufferViewCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
        info.buffer = buffer->handle();
        info.format = table_format(table);
        info.range = VK_WHOLE_SIZE;
        VkBufferView view = VK_NULL_HANDLE;
        const VkResult result = vkCreateBufferView(device.handle(), &info, nullptr, &view);
        if (result != VK_SUCCESS) {
            return vulkan_error(std::string("create a view of the table '") + table_name(table) + "'", result);
        }
        views_[table] = {device.handle(), view, vkDestroyBufferView};
    }
    buffers_[table] = std::move(*buffer);
    return Status::success();
}

}  // namespace source_core

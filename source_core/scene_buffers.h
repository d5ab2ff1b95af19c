// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "source_core/device/buffer.h"
#include "source_core/device/kernel_set.h"

namespace source_core {

/// The format in which kernels read a table: its row is one element of a texel buffer.
VkFormat table_format(uint32_t table);

/// How a table of `bytes` is reached: through a texel buffer while it fits, then a storage buffer, then an address.
/// Fails with out_of_memory where the device has no addresses and the table needs one.
Result<TableAccess> choose_access(const DeviceLimits& limits, uint32_t table, uint64_t bytes);

/// Bytes that a table takes on the device: an empty one still has rows, because kernels that run several lanes at
/// once read row 0 for the lanes that need none.
uint64_t table_bytes(uint64_t bytes);

/// The scene tables on the device.
class SceneBuffers {
public:
    /// Replaces table `table` by one of `bytes`, zeros after its rows. The old one is freed first.
    Status replace(const Device& device, MemoryBudget& budget, const Staging& staging, uint32_t table,
                   std::span<const std::byte> rows, uint64_t bytes, TableAccess access);

    const Buffer& buffer(uint32_t table) const { return buffers_[table]; }
    VkBufferView view(uint32_t table) const { return views_[table].get(); }

private:
    std::array<Buffer, TABLE_COUNT> buffers_;
    std::array<Handle<VkBufferView>, TABLE_COUNT> views_;
};

}  // namespace source_core

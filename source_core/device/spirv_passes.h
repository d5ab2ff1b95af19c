// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace source_core {

/// Decorates the result of every instruction that computes floats (arithmetic and the extended set GLSL.std.450) with
/// NoContraction, so that a driver neither fuses nor reassociates: both cores promise the same bits. Results that
/// carry the decoration already are left alone. `words` must be a valid module.
std::vector<uint32_t> forbid_contraction(const std::vector<uint32_t>& words);

/// Decorates storage buffers that no instruction writes with NonWritable and those that none reads with NonReadable:
/// synchronization validation then knows what a dispatch does. Functions that are never called must be gone.
std::vector<uint32_t> mark_buffer_access(const std::vector<uint32_t>& words);

}  // namespace source_core

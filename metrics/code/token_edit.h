// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace metrics {

/// Levenshtein's distance: the fewest symbols inserted, deleted or replaced that turn one sequence into the other.
/// Bit-parallel (Myers 1999, in the blocks of Hyyro 2003) and in a band that grows to hold the edit (Ukkonen 1985):
/// some |a| / 64 x distance steps, at most |a| / 64 x |b|; memory linear in |a| + |b|.
uint64_t edit_distance(std::span<const uint32_t> a, std::span<const uint32_t> b);

/// The distance, if it is `most` at most: so in time linear in |a| + |b|.
std::optional<uint64_t> edit_distance_within(std::span<const uint32_t> a, std::span<const uint32_t> b, uint64_t most);

/// 1 - distance / length of the longer side: 1 is alike, 0 has nothing in place. One side must not be empty.
double edit_similarity(std::span<const uint32_t> a, std::span<const uint32_t> b);

}  // namespace metrics

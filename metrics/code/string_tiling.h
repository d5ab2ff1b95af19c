// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "metrics/code/winnowing.h"

namespace metrics {

struct TilingParameters {
    uint32_t minimum = 9;              ///< the shortest tile, in symbols; 9 is JPlag's default for Java
    uint64_t most_pairs = 10'000'000;  ///< pairs of equal runs of that length; with more, nothing is computed
};

/// Greedy string tiling (Wise 1993; JPlag: Prechelt, Malpohl, Philippsen 2002): takes the longest run that both sides
/// have and no tile covers, again and again, down to the minimum; of equally long ones that first in a, then in b. Each
/// symbol lies in one tile at most. Sorted by a. Runs are found by Karp-Rabin hashes and compared symbol by symbol.
/// Nothing if the sides repeat themselves so much that it would take too long.
std::optional<std::vector<TokenMatch>> greedy_tiles(std::span<const uint32_t> a, std::span<const uint32_t> b,
                                                    const TilingParameters& parameters = {});

/// 2 x tiled symbols / (symbols of a + symbols of b): 1 is alike, 0 has no tile. The sizes must not both be 0.
double tiling_similarity(std::span<const TokenMatch> tiles, size_t size_a, size_t size_b);

}  // namespace metrics

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/code/string_tiling.h"

#include <algorithm>
#include <queue>
#include <unordered_map>

namespace metrics {
namespace {

/// Longest first, then first in a, then in b.
struct ComesLater {
    bool operator()(const TokenMatch& x, const TokenMatch& y) const {
        if (x.length != y.length) return x.length < y.length;
        return x.a != y.a ? x.a > y.a : x.b > y.b;
    }
};

using Queue = std::priority_queue<TokenMatch, std::vector<TokenMatch>, ComesLater>;

/// Where each run of the minimum's length stands in b, by its hash.
using Places = std::unordered_map<uint64_t, std::vector<uint32_t>>;

/// All maximal runs that both sides have, of the minimum's length at least. Nothing if there are too many pairs.
std::optional<Queue> maximal_matches(std::span<const uint32_t> a, std::span<const uint32_t> b,
                                     const TilingParameters& parameters) {
    const WinnowingParameters hashing{parameters.minimum, 1};
    const std::vector<uint64_t> in_a = kgram_hashes(a, hashing), in_b = kgram_hashes(b, hashing);
    Places places;
    for (uint32_t j = 0; j < in_b.size(); ++j) places[in_b[j]].push_back(j);
    uint64_t pairs = 0;
    for (const uint64_t hash : in_a)
        if (const auto found = places.find(hash); found != places.end()) pairs += found->second.size();
    if (pairs > parameters.most_pairs) return std::nullopt;
    Queue queue;
    for (uint32_t i = 0; i < in_a.size(); ++i) {
        const auto found = places.find(in_a[i]);
        if (found == places.end()) continue;
        for (const uint32_t j : found->second) {
            if (i > 0 && j > 0 && a[i - 1] == b[j - 1]) continue;  // part of a run that starts earlier
            uint32_t length = 0;
            while (i + length < a.size() && j + length < b.size() && a[i + length] == b[j + length]) ++length;
            if (length >= parameters.minimum) queue.push({i, j, length});
        }
    }
    return queue;
}

}  // namespace

std::optional<std::vector<TokenMatch>> greedy_tiles(std::span<const uint32_t> a, std::span<const uint32_t> b,
                                                    const TilingParameters& parameters) {
    std::optional<Queue> queue = maximal_matches(a, b, parameters);
    if (!queue) return std::nullopt;
    std::vector<uint8_t> taken_a(a.size()), taken_b(b.size());
    std::vector<TokenMatch> tiles;
    while (!queue->empty()) {
        const TokenMatch match = queue->top();
        queue->pop();
        // What longer tiles have left of the run; its pieces wait for their turn.
        for (uint32_t at = 0; at < match.length;) {
            uint32_t end = at;
            while (end < match.length && taken_a[match.a + end] == 0 && taken_b[match.b + end] == 0) ++end;
            const TokenMatch piece{match.a + at, match.b + at, end - at};
            if (piece == match) {
                std::fill_n(taken_a.begin() + piece.a, piece.length, uint8_t{1});
                std::fill_n(taken_b.begin() + piece.b, piece.length, uint8_t{1});
                tiles.push_back(piece);
            } else if (piece.length >= parameters.minimum) {
                queue->push(piece);
            }
            at = end + 1;
        }
    }
    std::sort(tiles.begin(), tiles.end(), [](const TokenMatch& x, const TokenMatch& y) { return x.a < y.a; });
    return tiles;
}

double tiling_similarity(std::span<const TokenMatch> tiles, size_t size_a, size_t size_b) {
    double tiled = 0;
    for (const TokenMatch& tile : tiles) tiled += tile.length;
    return 2 * tiled / static_cast<double>(size_a + size_b);
}

}  // namespace metrics

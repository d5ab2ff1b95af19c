// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/code/string_tiling.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace metrics {
namespace {

/// Longest first, then first in a, then in b.
struct ComesLater {
    bool operator()(const TokenMatch& x, const TokenMatch& y) const {
        if (x.length != y.length) return x.length < y.length;
        return x.a != y.a ? x.a > y.a : x.b > y.b;
    }
};

/// Where each run of the minimum's length stands in b: its places by hash, those of one hash ascending.
class Places {
public:
    explicit Places(std::span<const uint64_t> hashes) : hashes_(hashes), places_(hashes.size()) {
        std::iota(places_.begin(), places_.end(), 0u);
        std::stable_sort(places_.begin(), places_.end(),
                         [&](uint32_t x, uint32_t y) { return hashes_[x] < hashes_[y]; });
    }

    std::span<const uint32_t> of(uint64_t hash) const {
        const auto found = std::ranges::equal_range(places_, hash, {}, [&](uint32_t at) { return hashes_[at]; });
        return {found.begin(), found.end()};
    }

private:
    std::span<const uint64_t> hashes_;
    std::vector<uint32_t> places_;
};

/// The runs in the order in which tiles are made of them. They come in order of place, so that counting is enough.
std::vector<TokenMatch> longest_first(const std::vector<TokenMatch>& runs) {
    uint32_t longest = 0;
    for (const TokenMatch& run : runs) longest = std::max(longest, run.length);
    std::vector<size_t> start(longest + 2);  // of the runs of each length, counted from the longest
    for (const TokenMatch& run : runs) ++start[longest - run.length + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<TokenMatch> sorted(runs.size());
    for (const TokenMatch& run : runs) sorted[start[longest - run.length]++] = run;
    return sorted;
}

/// All maximal runs that both sides have, of the minimum's length at least, in order of their tiles. Nothing if there
/// are too many pairs.
std::optional<std::vector<TokenMatch>> maximal_matches(std::span<const uint32_t> a, std::span<const uint32_t> b,
                                                       const TilingParameters& parameters) {
    const WinnowingParameters hashing{parameters.minimum, 1};
    const std::vector<uint64_t> in_a = kgram_hashes(a, hashing), in_b = kgram_hashes(b, hashing);
    const Places places(in_b);
    std::vector<std::span<const uint32_t>> partners(in_a.size());
    uint64_t pairs = 0;
    for (uint32_t i = 0; i < in_a.size(); ++i) pairs += (partners[i] = places.of(in_a[i])).size();
    if (pairs > parameters.most_pairs) return std::nullopt;
    std::vector<TokenMatch> runs;
    for (uint32_t i = 0; i < in_a.size(); ++i)
        for (const uint32_t j : partners[i]) {
            if (i > 0 && j > 0 && a[i - 1] == b[j - 1]) continue;  // part of a run that starts earlier
            uint32_t length = 0;
            while (i + length < a.size() && j + length < b.size() && a[i + length] == b[j + length]) ++length;
            if (length >= parameters.minimum) runs.push_back({i, j, length});
        }
    return longest_first(runs);
}

}  // namespace

std::optional<std::vector<TokenMatch>> greedy_tiles(std::span<const uint32_t> a, std::span<const uint32_t> b,
                                                    const TilingParameters& parameters) {
    const std::optional<std::vector<TokenMatch>> runs = maximal_matches(a, b, parameters);
    if (!runs) return std::nullopt;
    std::vector<uint8_t> taken_a(a.size()), taken_b(b.size());
    std::vector<TokenMatch> tiles;
    std::priority_queue<TokenMatch, std::vector<TokenMatch>, ComesLater> pieces;
    for (size_t next = 0; next < runs->size() || !pieces.empty();) {
        const bool is_piece = next == runs->size() || (!pieces.empty() && ComesLater()((*runs)[next], pieces.top()));
        const TokenMatch match = is_piece ? pieces.top() : (*runs)[next];
        if (is_piece)
            pieces.pop();
        else
            ++next;
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
                pieces.push(piece);
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

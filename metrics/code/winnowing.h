// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace metrics {

/// Symbols from here on are separators: no run goes across one, and none may occur twice, on either side.
inline constexpr uint32_t FIRST_SEPARATOR = 0x80000000u;

/// k: the shortest run that can be found, in symbols. w: hashes in a window; each window yields one fingerprint.
struct WinnowingParameters {
    uint32_t k = 12;
    uint32_t w = 8;
    uint32_t hash_bits = 64;  ///< fewer make collisions, for tests: they cost time and never count

    /// t: each run of this many symbols that both sides have is found.
    uint32_t guarantee() const { return w + k - 1; }
};

/// A run of symbols that is equal on both sides, symbol by symbol: [a, a + length) and [b, b + length).
struct TokenMatch {
    uint32_t a = 0;
    uint32_t b = 0;
    uint32_t length = 0;

    bool operator==(const TokenMatch&) const = default;
};

/// The hash of each run of k symbols; empty for fewer than k symbols.
std::vector<uint64_t> kgram_hashes(std::span<const uint32_t> symbols, const WinnowingParameters& parameters);

/// Robust winnowing (Schleimer, Wilkerson, Aiken 2003, section 5.1): the positions of the least hash of each window of
/// w; among equal ones that of the window before if it is still in view, else the rightmost. The first window is a full
/// one: nothing is selected for the head alone. Fewer hashes than w make one window. Ascending.
std::vector<uint32_t> winnow(std::span<const uint64_t> hashes, uint32_t w);

/// The runs that two sequences share, found where a fingerprint of one is a fingerprint of the other, compared symbol
/// by symbol and extended as far as both agree. Sorted by a, then b; they may overlap. Exchanging the sides exchanges a
/// and b of each match. Takes linear time: of a fingerprint that is very common on both sides each occurrence is held
/// against a few of the others only, so that it still counts as found, if not always in its longest run.
std::vector<TokenMatch> winnowing_matches(std::span<const uint32_t> a, std::span<const uint32_t> b,
                                          const WinnowingParameters& parameters = {});

/// A sequence without separators, and what matching needs to know of it.
struct PrintedSequence {
    PrintedSequence(std::vector<uint32_t> text, const WinnowingParameters& parameters);

    std::vector<uint32_t> symbols;
    std::vector<uint64_t> hashes;                       ///< of each run of k symbols
    std::vector<std::pair<uint64_t, uint32_t>> prints;  ///< fingerprints with their places, by hash, then place
};

/// The same for prepared sequences.
std::vector<TokenMatch> winnowing_matches(const PrintedSequence& a, const PrintedSequence& b,
                                          const WinnowingParameters& parameters);

/// 1 for each symbol of a side that lies in a match, else 0. `size` is the number of symbols of that side.
std::vector<uint8_t> covered_in_a(std::span<const TokenMatch> matches, size_t size);
std::vector<uint8_t> covered_in_b(std::span<const TokenMatch> matches, size_t size);

/// The matches without those that cover nothing more, on either side, than longer ones do. Sorted by a, then b.
std::vector<TokenMatch> essential_matches(std::vector<TokenMatch> matches, size_t size_a, size_t size_b);

}  // namespace metrics

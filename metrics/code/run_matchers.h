// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "metrics/code/winnowing.h"

// The two halves of winnowing_matches(), for those who keep the fingerprints otherwise.
namespace metrics {

/// Of a fingerprint that comes in more pairs than this, each occurrence is held against a few of the others only.
inline constexpr size_t MOST_PAIRS = 1024;

struct HashedSymbols {
    std::span<const uint32_t> symbols;
    std::span<const uint64_t> hashes;  ///< of each run of k symbols
};

/// An occurrence of a shared fingerprint on one side: where it stands, its rank among those of its side, and the
/// occurrences on the other side.
struct Place {
    uint32_t at;
    uint32_t rank, of;
    std::span<const uint32_t> partners;
};

/// Finds and extends matches of two texts, and then of two others; remembers on each diagonal (b - a) the last one, to
/// extend nothing twice.
class Matcher {
public:
    explicit Matcher(const WinnowingParameters& parameters) : k_(parameters.k), w_(parameters.w) {}

    void start(const HashedSymbols& a, const HashedSymbols& b) {
        a_ = a;
        b_ = b;
        last_.resize(std::max(last_.size(), a.symbols.size() + b.symbols.size() + 1));
    }

    /// The matches since the start.
    std::vector<TokenMatch> take() {
        for (const TokenMatch& match : matches_) last_[match.b + a_.symbols.size() - match.a] = {};
        return std::exchange(matches_, {});
    }

    /// A pair, and those beside it that have the same hash: where a k-gram comes twice in one window the two sides may
    /// have selected different ones of it, on different diagonals.
    void run(uint32_t i, uint32_t j) {
        match(i, j);
        match_beside(i, j);
    }

private:
    void match_beside(uint32_t i, uint32_t j) {
        const std::span<const uint64_t> x = a_.hashes, y = b_.hashes;
        for (uint32_t step = 1; step < w_; ++step) {
            if (j + step < y.size() && y[j + step] == y[j]) match(i, j + step);
            if (j >= step && y[j - step] == y[j]) match(i, j - step);
            if (i + step < x.size() && x[i + step] == x[i]) match(i + step, j);
            if (i >= step && x[i - step] == x[i]) match(i - step, j);
        }
    }

    void match(uint32_t i, uint32_t j) {
        TokenMatch& last = last_[j + a_.symbols.size() - i];
        if (i >= last.a && i < last.a + last.length) return;
        const std::span<const uint32_t> x = a_.symbols, y = b_.symbols;
        uint32_t end = 0;
        while (i + end < x.size() && j + end < y.size() && x[i + end] == y[j + end]) ++end;
        if (end < k_) return;  // a collision of hashes
        uint32_t before = 0;
        while (before < i && before < j && x[i - before - 1] == y[j - before - 1]) ++before;
        last = {i - before, j - before, before + end};
        matches_.push_back(last);
    }

    HashedSymbols a_, b_;
    uint32_t k_, w_;
    std::vector<TokenMatch> matches_, last_;
};

/// Holds the occurrences of very common fingerprints on one side against a few partners each, skipping what is covered.
class CommonMatcher {
public:
    CommonMatcher(std::span<const uint32_t> own, std::span<const uint32_t> other, uint32_t k,
                  std::vector<uint8_t> covered)
        : own_(own), other_(other), k_(k), covered_(std::move(covered)) {}

    std::vector<TokenMatch> matches;  ///< a: own side

    void run(const std::vector<Place>& places) {
        int64_t diagonal = 0;
        for (const Place& place : places) {
            if (is_covered(place.at)) continue;
            TokenMatch best;
            auto attempt = [&](int64_t partner) {
                if (partner < 0 || partner + k_ > static_cast<int64_t>(other_.size())) return;
                const TokenMatch found = extend(place.at, static_cast<uint32_t>(partner));
                if (found.length > best.length) best = found;
            };
            attempt(place.at + diagonal);
            const size_t count = place.partners.size();
            attempt(place.partners[std::min<size_t>(place.rank, count - 1)]);
            constexpr size_t kSpread = 6;
            for (size_t step = 0; step < kSpread; ++step)
                attempt(place.partners[(static_cast<size_t>(place.rank) * count / place.of + step * count / kSpread) %
                                       count]);
            if (best.length < k_) continue;
            diagonal = static_cast<int64_t>(best.b) - best.a;
            std::fill_n(covered_.begin() + best.a, best.length, uint8_t{1});
            matches.push_back(best);
        }
    }

private:
    bool is_covered(uint32_t at) const {
        return std::find(covered_.begin() + at, covered_.begin() + at + k_, 0) == covered_.begin() + at + k_;
    }

    /// To the right as far as it goes; to the left as far as nothing is covered yet, which keeps the time linear.
    TokenMatch extend(uint32_t i, uint32_t j) const {
        const std::span<const uint32_t> x = own_, y = other_;
        uint32_t end = 0;
        while (i + end < x.size() && j + end < y.size() && x[i + end] == y[j + end]) ++end;
        if (end < k_) return {};
        uint32_t before = 0;
        while (before < i && before < j && covered_[i - before - 1] == 0 && x[i - before - 1] == y[j - before - 1])
            ++before;
        return {i - before, j - before, before + end};
    }

    const std::span<const uint32_t> own_, other_;
    uint32_t k_;
    std::vector<uint8_t> covered_;
};

}  // namespace metrics

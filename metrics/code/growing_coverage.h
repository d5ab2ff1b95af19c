// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "metrics/code/winnowing.h"

namespace metrics {

/// A sequence without separators, and what matching needs to know of it.
struct PrintedSequence {
    PrintedSequence(std::vector<uint32_t> text, const WinnowingParameters& parameters);

    std::vector<uint32_t> symbols;
    std::vector<uint64_t> hashes;                       ///< of each run of k symbols
    std::vector<std::pair<uint64_t, uint32_t>> prints;  ///< fingerprints with their places, by hash, then place
};

/// Which symbols of two lists of sequences winnowing_matches() would cover if a separator stood between the sequences
/// of each list. Kept up to date as sequences come and go: what did not change is not matched again, except for very
/// common fingerprints, whose matches depend on all the rest.
class GrowingCoverage {
public:
    explicit GrowingCoverage(const WinnowingParameters& parameters) : parameters_(parameters) {}

    /// A sequence in its list; the number tells it from the others of its list, and stands for the same sequence
    /// always.
    struct Member {
        uint32_t number = 0;
        std::shared_ptr<const PrintedSequence> sequence;
    };
    using Members = std::vector<Member>;
    /// 1 for each symbol of a list that lies in a match; sequence i has those from first[i] on.
    struct Covered {
        std::vector<uint8_t> symbols;
        std::vector<size_t> first;
    };

    /// Both lists as they are from now on, and what is covered of each.
    std::array<Covered, 2> update(const Members& a, const Members& b);

private:
    struct Known {
        std::shared_ptr<const PrintedSequence> sequence;
        uint32_t order = 0;            ///< in its list
        std::set<uint32_t> partners;   ///< those of the other list that share a rare fingerprint's run with it
        std::vector<uint8_t> covered;  ///< by the matches of rare fingerprints
        bool stale = true;             ///< `covered` is to be made anew
    };
    struct Occurrence {
        uint32_t number = 0, at = 0;
    };
    /// All places of one fingerprint.
    struct Group {
        std::array<std::vector<Occurrence>, 2> places;
        bool common = false;

        bool is_common() const { return places[0].size() * places[1].size() > kMostPairs; }
    };
    using Pair = std::pair<uint32_t, uint32_t>;  ///< numbers in either list
    static const size_t kMostPairs;

    void remove(size_t side, uint32_t number);
    void add(size_t side, const Member& member);
    void regroup();
    void match_again(const Pair& pair);
    void cover(size_t side, Known& known, uint32_t number);
    void add_common_matches(const std::array<std::vector<uint32_t>, 2>& texts, std::array<Covered, 2>& covered);

    WinnowingParameters parameters_;
    std::array<std::unordered_map<uint32_t, Known>, 2> known_;
    std::unordered_map<uint64_t, Group> groups_;
    std::unordered_set<uint64_t> common_;
    std::map<Pair, std::vector<TokenMatch>> matches_;  ///< of rare fingerprints, by places in the two sequences
    // Within one update.
    std::vector<uint64_t> touched_;
    std::array<std::set<uint32_t>, 2> added_;
    std::set<Pair> changed_;
};

}  // namespace metrics

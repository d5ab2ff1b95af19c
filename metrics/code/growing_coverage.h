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

#include "metrics/code/run_matchers.h"

namespace metrics {

/// Which symbols of two lists of sequences winnowing_matches() would cover if a separator stood between the sequences
/// of each list. Kept up to date as sequences come and go: what did not change is not matched again, except for very
/// common fingerprints, whose matches depend on all the rest.
class GrowingCoverage {
public:
    explicit GrowingCoverage(const WinnowingParameters& parameters) : parameters_(parameters), matcher_(parameters) {}

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
        uint32_t order = 0;           ///< in its list
        std::set<uint32_t> partners;  ///< those of the other list that share a rare fingerprint's run with it
        /// How many matches of rare fingerprints start here, less those that have ended just before.
        std::vector<int32_t> steps;
        std::vector<uint8_t> covered;  ///< by these
        bool stale = true;             ///< `covered` is to be made anew
    };
    struct Occurrence {
        uint32_t number = 0, at = 0;
    };
    /// All places of one fingerprint.
    struct Group {
        std::array<std::vector<Occurrence>, 2> places;
        bool common = false;

        bool is_common() const { return places[0].size() * places[1].size() > MOST_PAIRS; }
    };
    using Pair = std::pair<uint32_t, uint32_t>;  ///< numbers in either list

    void list(size_t side, const Members& members);
    void remove(size_t side, uint32_t number);
    void add(size_t side, const Member& member);
    void regroup();
    void note_turned(const Group& group);
    void note_fresh(size_t side, uint32_t number);
    void match_again(const Pair& pair);
    void count(size_t side, uint32_t number, const std::vector<TokenMatch>& matches, int32_t by);
    static void cover(Known& known);
    void add_common_matches(const std::array<std::vector<uint32_t>, 2>& texts, std::array<Covered, 2>& covered);

    WinnowingParameters parameters_;
    std::array<std::unordered_map<uint32_t, Known>, 2> known_;
    std::unordered_map<uint64_t, Group> groups_;
    std::unordered_set<uint64_t> common_;
    std::map<Pair, std::vector<TokenMatch>> matches_;  ///< of rare fingerprints, by places in the two sequences
    Matcher matcher_;
    // Within one update.
    std::vector<uint64_t> touched_;
    std::array<std::vector<uint32_t>, 2> added_;
    std::vector<Pair> changed_;
};

}  // namespace metrics

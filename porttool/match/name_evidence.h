// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "porttool/match/features.h"

namespace porttool {

/// Two units that the matcher has put together so far; certain if they stand out from all others.
struct LearnedPair {
    uint32_t source = 0, target = 0;
    bool certain = false;
};

/// How the names of two units differ, seen against the names of the whole project. All in [0, 1].
struct NameDifference {
    float lost = 0;            ///< how likely a port would have kept a word that the target's name lacks
    float gained = 0;          ///< the same the other way round
    float lost_variant = 0;    ///< how often a lost word marks a variant that only the source has
    float gained_variant = 0;  ///< how often a gained word marks a variant that only the target has
};

/// What the pairs of a project tell about its names. `dot_q4_0` resembles `dot_q4_1` in everything, but certain pairs
/// keep such words, while `cuda` becomes `sycl` all over. And where `dot` and `dot_reorder` stand side by side and
/// `dot` is the one with a counterpart, `reorder` is no part of a port's name.
class NameEvidence {
public:
    NameEvidence(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                 const TermNumbers& terms, const std::vector<LearnedPair>& pairs);
    ~NameEvidence();

    /// Between names about one thing, words that tell how count little, unless the two speak of different types.
    NameDifference difference(const UnitFeatures& from, const UnitFeatures& to) const;

private:
    struct Learned;

    NameDifference weigh(const std::vector<uint32_t>& lost, const std::vector<uint32_t>& gained) const;

    std::unique_ptr<const Learned> learned_;
};

/// The weight of a difference against a pair, in log odds.
float doubt(const NameDifference& difference);

}  // namespace porttool

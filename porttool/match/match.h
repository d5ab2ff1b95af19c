// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/scan/unit.h"

namespace porttool {

enum class PairState : uint8_t { Confirmed, Suggested };

/// Two units by their ids; the score is the confidence that they belong together.
struct MatchedPair {
    std::string source, target;
    float score = 0;
    PairState state = PairState::Suggested;
};

struct Matching {
    std::vector<MatchedPair> pairs;            ///< sorted by source, then target
    std::vector<std::string> unmapped_source;  ///< sorted
    std::vector<std::string> unmapped_target;
};

/// What a person has settled before the matcher looks.
struct Settled {
    std::vector<std::pair<std::string, std::string>> pairs;  ///< ids; a source may stand in several
    std::vector<std::string> ignored;                        ///< ids or globs of ids: neither paired nor unmapped
};

/// Pairs the units of two sides. Settled pairs are confirmed; of the rest each unit stands in at most one pair, and a
/// unit without a counterpart stays unmapped.
Matching match_units(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target,
                     const Settled& settled, const Dialect& dialect);

}  // namespace porttool

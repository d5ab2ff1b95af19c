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
    std::vector<std::string> ports;  ///< where several lie side by side in the target: what tells them apart
};

/// What a person has settled before the matcher looks.
struct Settled {
    std::vector<std::pair<std::string, std::string>> pairs;  ///< ids; a source may stand in several
    std::vector<std::string> ignored;                        ///< ids or globs of ids: neither paired nor unmapped
    bool shares = false;  ///< a target of `pairs` may be suggested for further sources, as variants of the settled one
};

/// Pairs the units of two sides. Where the target holds several ports side by side, each is paired for itself. Settled
/// pairs are confirmed, and teach how names change; a settled source gets no further target. Of the rest several
/// sources may share a target, and one source have several, where they are variants or copies of each other; a unit
/// without a counterpart stays unmapped. What does this one unit resemble? Settle all others of its side, each with ""
/// in the place of the other, and what is left are its pairs.
Matching match_units(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target,
                     const Settled& settled, const Dialect& dialect);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "metrics/code/winnowing.h"
#include "porttool/language/dialect.h"
#include "porttool/measure/code_lines.h"
#include "porttool/measure/symbols.h"

namespace porttool {

/// What is measured on one side. Percentages are 0 to 100; absent if a side is too short to hold a match.
struct SideMeasure {
    uint32_t lines = 0;   ///< with code
    uint32_t tokens = 0;  ///< of code, in the common vocabulary of the dialects
    uint32_t shared_lines = 0;
    std::optional<double> moss_percent;        ///< of the tokens, those in matches; identifiers kept
    std::optional<double> moss_percent_blind;  ///< all names but the dialects' own are one
    std::optional<double> moss_percent_raw;    ///< of the tokens as they are written
};

/// Lines [first, last] of an excerpt; `excerpt` is its place in the passage.
struct ExcerptLines {
    uint32_t excerpt = 0;
    uint32_t first = 0;
    uint32_t last = 0;

    bool operator==(const ExcerptLines&) const = default;
};

/// A run of tokens that both sides have, by its lines.
struct LineMatch {
    ExcerptLines a, b;
};

/// A line with code, and whether at least half of its tokens lie in matches.
struct CodeLine {
    uint32_t line = 0;
    bool shared = false;
};

struct Similarity {
    SideMeasure a, b;
    /// 0 to 1, both sides in one figure; absent: `unmeasured` says why, under the figure's name.
    std::optional<double> tiling;           ///< greedy string tiling: 1 is alike
    std::optional<double> token_edit;       ///< 1 - edit distance / longer side
    std::optional<double> tree_distance;    ///< 0 is alike; functions only, or files by their functions
    std::optional<double> line_divergence;  ///< 0 is alike
    std::map<std::string, std::string> unmeasured;
    std::vector<LineMatch> matches;              ///< in the order of a, then b
    std::vector<std::vector<CodeLine>> a_lines;  ///< one list per excerpt
    std::vector<std::vector<CodeLine>> b_lines;
};

/// Everything in SideMeasure, `line_divergence`, the matches and the lines; linear time, for passages of any size. The
/// other figures stay absent.
Similarity measure_shares(const Passage& a, const Passage& b, const Dialect& dialect,
                          const metrics::WinnowingParameters& parameters = {});

/// The lines of a side `b` of one excerpt, ascending, at least half of whose tokens lie in matches with `a`: the shared
/// ones of measure_shares, for sequences in the dialects' vocabulary.
std::vector<uint32_t> half_shared_lines(const SymbolSequence& a, const std::vector<PlacedToken>& b_tokens,
                                        const SymbolSequence& b);

/// All figures; those whose cost grows faster than the text are left out, with the reason, where it is too long.
Similarity measure(const Passage& a, const Passage& b, const Dialect& dialect,
                   const metrics::WinnowingParameters& parameters = {});

}  // namespace porttool

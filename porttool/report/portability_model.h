// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "metrics/portability/figure.h"
#include "porttool/judge/judge.h"
#include "porttool/measure/measure.h"
#include "porttool/measure/portability_accounting.h"
#include "porttool/measure/portability_alignment.h"
#include "porttool/measure/portability_blocks.h"

namespace porttool {

/// Consecutive lines of one file.
struct FileLines {
    std::string file;
    std::vector<LineSpan> code, shared;
};

/// A functional block, or both sides as a whole. The first of each pair is the source's, the second the target's.
struct BlockReport {
    std::string name;
    std::array<SideMeasure, 2> measures;
    std::array<LineParts, 2> parts;
    std::array<std::vector<FileLines>, 2> lines;     ///< what the figures were counted from
    std::optional<metrics::Figure> portability;      ///< by lines; none where a side is too short
    std::array<std::pair<size_t, size_t>, 2> alone;  ///< lines, and shared ones, that lie in no smaller block
};

/// True where both sides hold code and nothing can be measured: what they share is not known, and not novel either.
bool is_too_short(const BlockReport& block);

/// One side of a row.
struct RowSide {
    std::string id, file, name;
    std::string_view kind;
    LineSpan span;     ///< from the head to the closing brace
    size_t lines = 0;  ///< of code, that count here
    std::vector<LineSpan> code, shared;
    UnitPlace place;  ///< `unit` is nullptr for code outside units
    int block = -1;   ///< the smallest one that holds it
    std::vector<int> blocks;
};

/// A pair (with one side if the other is gone), or what stands alone: a unit without counterpart, or the code of a file
/// that lies outside units.
struct RowReport {
    std::string key;  ///< names the row in addresses: an id, or SOURCE=TARGET
    Share share = Share::Unmatched;
    std::string state;   ///< of pairs: in_step, review, drifted, deferred or ignored
    std::string reason;  ///< why it needs no counterpart
    std::array<std::optional<RowSide>, 2> sides;
    std::array<SideMeasure, 2> measures;  ///< of pairs
    std::optional<double> likeness;       ///< what share was decided by, in percent
};

/// Everything that the portability report says but for the drift ledger.
struct PortabilityReport {
    std::vector<BlockReport> blocks;
    bool blocks_are_file_pairs = false;
    BlockReport totals;
    std::vector<RowReport> rows;
    std::array<std::pair<size_t, size_t>, 2> in_no_block;  ///< lines, and shared ones
};

/// What a report rests on.
struct PortabilityCase {
    const MapFile& map;
    const LockFile& lock;
    const std::vector<ScannedFile>& source;
    const std::vector<ScannedFile>& target;
    const Judgement& judgement;
    const BlockTexts& blocks;
};

/// A pair whose likeness is at least this is a twin. Percent of the tokens of either side.
inline constexpr double kTwinBound = 50;

/// Measures blocks and pairs and accounts for every line of code of both sides: twin + rewritten + one-sided +
/// unmatched = total, on each side (asserted).
PortabilityReport portability_report(const PortabilityCase& facts);

}  // namespace porttool

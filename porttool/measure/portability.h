// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "porttool/judge/judge.h"
#include "porttool/measure/accounting.h"
#include "porttool/measure/blocks.h"
#include "porttool/measure/passage_measure.h"

namespace porttool {

/// The lines of code of one file, and those of them that are shared.
struct FileLines {
    std::string file;
    std::vector<LineSpan> code, shared;
};

/// How many lines, and shared ones.
struct LineCount {
    size_t lines = 0, shared = 0;
};

/// A functional block, or both sides as a whole.
struct BlockReport : MeasuredBlock {
    BySide<std::vector<FileLines>> lines;  ///< what the figures were counted from
    BySide<LineParts> parts;
    BySide<LineCount> alone;  ///< what lies in no smaller block
};

/// One side of a row.
struct RowSide {
    std::string id, file, name;
    std::string_view kind;
    LineSpan span;     ///< from the head to the closing brace
    size_t lines = 0;  ///< of code, that count here
    std::vector<LineSpan> code, shared;
    Excerpt excerpt;  ///< without a unit: a whole file, or code outside units
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
    BySide<std::optional<RowSide>> sides;
    BySide<SideMeasure> measures;    ///< of pairs
    std::optional<double> likeness;  ///< what share was decided by, in percent

    const RowSide& first() const { return sides.source ? *sides.source : *sides.target; }
};

/// Everything that the portability report says but for the drift ledger.
struct PortabilityReport {
    std::vector<BlockReport> blocks;
    bool blocks_are_file_pairs = false;
    BlockReport totals;
    std::vector<RowReport> rows;
    BySide<LineCount> in_no_block;
};

/// What a report rests on.
struct PortabilityCase {
    const MapFile& map;
    const std::vector<ScannedFile>& source;
    const std::vector<ScannedFile>& target;
    const Judgement& judgement;
};

/// A pair whose likeness is at least this is a twin. Percent of the tokens of either side.
inline constexpr double kTwinBound = 50;

/// The blocks that the map names, or one for each pair of files with a pair of units.
Blocks blocks_of(const PortabilityCase& facts);

/// Measures blocks and pairs and accounts for every line of code of both sides: twin + rewritten + one-sided +
/// unmatched = total, on each side (asserted).
PortabilityReport portability_report(const PortabilityCase& facts, const Blocks& blocks);

}  // namespace porttool

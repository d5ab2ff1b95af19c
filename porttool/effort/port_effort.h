// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "metrics/portability/degree.h"
#include "porttool/language/dialect.h"
#include "porttool/read/map_file.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// Lines of code that an edit added and removed. A line counts as changed if a token on it did: comments and white
/// space are no code.
struct LineEdit {
    size_t added = 0, removed = 0;
    size_t changed() const { return added + removed; }
};

/// What an edit to a source and the edit to its port have to do with each other.
struct PortedEdit {
    LineEdit source, target;
    double ported = 0;  ///< of the lines added to the source, those that the port gained, too; mean of its ports
    metrics::SharedLines carried;  ///< of the lines added to the port, those that the source has
    size_t common_tokens = 0;      ///< of the lines added on both sides, in the common vocabulary, each used once
    size_t source_tokens = 0, target_tokens = 0;

    size_t novel() const { return target.added - static_cast<size_t>(carried.shared); }
    /// 2 common / (source + target), 0 to 1; none where a side added nothing. The median is 0.78 for the two edits of
    /// true ports and 0.12 for edits that have nothing to do with each other.
    std::optional<double> similarity() const;
    /// The share of the lines added to the source that the port has; none where nothing was added.
    std::optional<double> carried_over() const;
};

/// A pair with an edit, by its ids in the map.
struct PairEffort {
    std::string source, target;
    PortedEdit edit;
};

/// An edit outside all pairs.
struct FileEffort {
    std::string file;
    LineEdit edit;
};

struct PortEffort {
    std::vector<PairEffort> pairs;  ///< sorted by id
    std::vector<FileEffort> source_outside, target_outside;
    PortedEdit totals;  ///< pairs and the rest; the lines of a unit in several pairs count once, its tokens in each
};

/// Both sides before and after a change.
struct ChangedSides {
    const std::vector<ScannedFile>& source_before;
    const std::vector<ScannedFile>& source_now;
    const std::vector<ScannedFile>& target_before;
    const std::vector<ScannedFile>& target_now;
};

/// What it took to port a change. A line that the port gained is carried over if the source as it is now has it after
/// translation and the port had not: as a whole line, or inside one run of at least 12 common tokens. The strictest
/// reading wants the line as it is written; the loosest is content with half of its tokens, as for shared lines
/// elsewhere, which for an edit within a line says little. All other lines that the port gained are novel, and so is
/// what it gained outside pairs. Nothing in it depends on the order of the pairs or of their targets.
PortEffort port_effort(const std::vector<MapPair>& pairs, const ChangedSides& sides, const Dialect& dialect);

}  // namespace porttool

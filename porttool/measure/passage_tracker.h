// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "metrics/code/growing_coverage.h"
#include "porttool/measure/measure.h"
#include "porttool/measure/symbols.h"
#include "porttool/scan/side.h"

namespace porttool {

/// A passage with the file that it is of.
struct PartText {
    std::shared_ptr<const ScannedFile> file;
    Passage passage;
};

/// What a passage takes of one file; read only where it must be measured. `contents`: equal only where the text is.
struct PassagePart {
    std::string path;
    std::string contents;
    std::function<PartText()> read;
};

using PartedPassage = std::vector<PassagePart>;

/// An excerpt as sequences of symbols.
struct PreparedExcerpt {
    std::array<std::shared_ptr<const metrics::PrintedSequence>, 3> sequences;  ///< by Vocabulary
    std::vector<uint32_t> line_of;  ///< of each symbol of Vocabulary::Dialect, the rank of its line
    uint32_t lines = 0;             ///< with code
};

struct PreparedPart {
    std::vector<PreparedExcerpt> excerpts;  ///< those with code
    bool moved = false;                     ///< a word's number depends on what else was read: see SymbolTable
};

/// Prepares each part once for all that measure it, in one dialect, which must outlive it.
class PartStore {
public:
    explicit PartStore(const Dialect& dialect) : table_(dialect) {}

    std::shared_ptr<const PreparedPart> part(const PassagePart& part);

private:
    SymbolTable table_;
    std::unordered_map<std::string, std::weak_ptr<const PreparedPart>> known_;
};

/// One of two passages held against each other: its figures, and each line of code in order, shared or not.
struct PassageSide {
    SideMeasure measure;
    std::vector<bool> shared;
};

/// Measures two passages again and again as their parts change, with the figures of measure_shares() to the last digit:
/// what is not changed is not matched again.
class PassageTracker {
public:
    /// The figures, or nothing where only the passages as a whole can tell them: they are very long, or two different
    /// words in them have one number.
    std::optional<BySide<PassageSide>> measure(const BySide<const PartedPassage*>& passages, PartStore& store);

private:
    struct Part {
        std::shared_ptr<const PreparedPart> prepared;
        uint32_t first = 0;  ///< number of its first excerpt
    };
    using Parts = std::map<std::pair<std::string, std::string>, Part>;  ///< by path and contents

    /// The symbols of a side in one vocabulary, and those of its longest sequence.
    struct Extent {
        size_t symbols = 0, longest = 0;
    };

    bool take(Side side, const PartedPassage& passage, PartStore& store);
    std::array<metrics::GrowingCoverage::Covered, 2> update(size_t vocabulary);
    BySide<Extent> extents(size_t vocabulary) const;
    void note_lines(Side side, const metrics::GrowingCoverage::Covered& covered, PassageSide& out) const;

    BySide<Parts> parts_;
    BySide<std::vector<const Part*>> order_;
    BySide<uint32_t> numbers_{0, 0};  ///< in use so far
    std::array<metrics::GrowingCoverage, 3> coverage_{metrics::GrowingCoverage({}), metrics::GrowingCoverage({}),
                                                      metrics::GrowingCoverage({})};
};

}  // namespace porttool

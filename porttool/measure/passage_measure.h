// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "metrics/portability/degree.h"
#include "porttool/measure/measure.h"
#include "porttool/measure/passage_tracker.h"
#include "porttool/read/blob_cache.h"
#include "porttool/scan/side.h"

namespace porttool {

/// Two passages held against each other.
using PassageMeasure = BySide<PassageSide>;

/// A functional block, or both sides as a whole (no name), with its figures.
struct MeasuredBlock {
    std::string name;
    PassageMeasure found;
    std::optional<metrics::Figure> degree;  ///< of portability; none where a side is empty or too short

    /// True where both sides hold code and nothing can be measured: what they share is not known, and not novel either.
    bool is_too_short() const;
};

/// The one measurement of a block, a pair, or both sides as a whole: each passage against the whole of the other.
PassageMeasure measure_passages(const Passage& source, const Passage& target, const Dialect& dialect);

/// The figures of a block from its measurement; the degree is Mooney's, by lines.
MeasuredBlock measured_block(const std::string& name, PassageMeasure found, const metrics::LineWeights& weights);

/// The code lines of each excerpt of a passage, with what a measurement of the passage says of them.
std::vector<std::vector<CodeLine>> measured_lines(const Passage& passage, const PassageSide& found);

/// The contents of all parts: equal only where the texts are.
std::string contents_of(const PartedPassage& passage);

/// The same measurement, taken once for the same contents and dialect; what follows another one under its name costs
/// little where little has changed.
class PassageMeasurer {
public:
    explicit PassageMeasurer(BlobCache& cache) : cache_(cache) {}  ///< which must outlive it

    /// The vocabulary that is measured in from now on.
    void use_dialect(const std::vector<std::pair<std::string, std::string>>& rows);

    const PassageMeasure& measure(const std::string& name, const PartedPassage& source, const PartedPassage& target);

private:
    PassageMeasure found(const std::string& name, const PartedPassage& source, const PartedPassage& target);

    BlobCache& cache_;
    Dialect dialect_;
    std::optional<PartStore> parts_;
    std::map<std::string, PassageTracker> trackers_;  ///< by name
    std::string dialect_key_;
    std::unordered_map<std::string, PassageMeasure> known_;
};

/// One line of text for a cache, and back; nothing if the text has not that form.
std::string facts_line(const PassageMeasure& measure);
std::optional<PassageMeasure> read_passage_measure(const std::string& line);

}  // namespace porttool

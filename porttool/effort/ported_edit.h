// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "metrics/portability/degree.h"
#include "porttool/effort/edited_lines.h"
#include "porttool/measure/code_lines.h"
#include "porttool/scan/side.h"

namespace porttool {

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

/// Under which readings a line that a port gained is carried over from its source; each holds under those before it.
/// Loose: half of its tokens are common, as for shared lines elsewhere. Usual: the source has it as a line, or within
/// one run. Strict: the source has it as it is written.
enum class Carried : uint8_t { No, Loose, Usual, Strict };

/// One for each line that the port gained, in order.
using CarriedLines = std::vector<Carried>;

/// Each line under the strictest of two readings; the lists are of one edit, or the first is empty.
void take_strictest(CarriedLines& lines, const CarriedLines& more);

void count_into(const CarriedLines& lines, metrics::SharedLines& out);

/// A unit of one side as it is now, and its edit.
struct EditedUnit {
    Excerpt now;
    EditedLines lines;
};

struct ComparedEdits {
    PortedEdit edit;
    CarriedLines carried;  ///< empty where one of the two units is gone
};

/// Compares the edits of a source and of its port.
///
///     source before   source now            port before    port now
///     c = a * b;      c = a * b;            c = a * b;     c = a * b;
///                     d = max(c, 0.0f);                    d = max(c, 0.0);
///                                                          store(d);
///     return c;       return d;             return c;      return d;
///
/// The source gained two lines and lost one; so did the port, but for `store(d)`. Translated, `max(c, 0.0f)` and
/// `max(c, 0.0)` are one text: both lines of the source are ported, two of the three that the port gained are carried
/// over, one of them (`return d;`) also as it is written, and `store(d)` is novel. Old code counts for the port, too:
/// had the source had `store(d)` all along and the port had not, it would be carried over now. What the port had
/// elsewhere does not.
ComparedEdits compare_ported(const EditedUnit& source, const EditedUnit& target, LineReader& reader,
                             const Dialect& dialect);

/// The words of the lines that an edit gained, in the common vocabulary, sorted; closing braces left out.
NumberedWords added_words(const EditedLines& edit, WordNumbers& words);

}  // namespace porttool

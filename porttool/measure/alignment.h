// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/measure/code_lines.h"

namespace porttool {

/// A stretch of a line that a reader should see: what the other side has not, or has under another name.
struct Mark {
    uint32_t first = 0;  ///< byte within the line
    uint32_t length = 0;
    bool translated = false;  ///< the dialect table makes the two sides equal here
};

/// Two lines side by side; 0 stands for no line on that side.
struct AlignedRow {
    uint32_t source_line = 0;
    uint32_t target_line = 0;
    std::vector<Mark> source_marks, target_marks;
};

/// Lays the lines of two excerpts side by side, in order, each line once: first lines that are equal once translated,
/// then, between them, lines that are alike. What differs within a row is marked. Takes roughly linear time for texts
/// that resemble each other; very long stretches without a common line are laid side by side in order.
std::vector<AlignedRow> align_units(const Excerpt& source, const Excerpt& target, const Dialect& dialect);

}  // namespace porttool

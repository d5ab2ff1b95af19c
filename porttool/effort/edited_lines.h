// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "porttool/effort/word_numbers.h"
#include "porttool/measure/code_lines.h"

namespace porttool {

/// Lines of code that an edit added and removed. A line counts as changed if a token on it did: comments and white
/// space are no code.
struct LineEdit {
    size_t added = 0, removed = 0;
    size_t changed() const { return added + removed; }
    LineEdit& operator+=(const LineEdit& more);
};

/// A line of code, by its words.
struct TextLine {
    uint32_t line = 0;               ///< in the file, from 1
    uint32_t text = 0;               ///< what it says: equal lines have equal numbers
    size_t first_word = 0, end = 0;  ///< in LinesOfCode::words
};

struct LinesOfCode {
    std::vector<TextLine> lines;
    NumberedWords words;

    std::span<const uint32_t> words_of(const TextLine& line) const {
        return std::span(words).subspan(line.first_word, line.end - line.first_word);
    }
};

/// Reads the texts of a change; numbers mean the same in all that one reader has read.
class LineReader {
public:
    explicit LineReader(const Dialect& dialect) : words(dialect) {}

    /// The lines of code of an excerpt; none of one without a file.
    LinesOfCode read(const Excerpt& excerpt);

    WordNumbers words;

private:
    SequenceNumbers texts_;
};

/// An edit of one excerpt: the lines as they are now, and which of them are new.
struct EditedLines {
    LinesOfCode now;
    std::vector<size_t> added;  ///< indices into now.lines, ascending
    LineEdit edit;

    const TextLine& added_line(size_t n) const { return now.lines[added[n]]; }
    /// Does this line of the file hold something new?
    bool is_new(uint32_t line) const;
};

EditedLines edited_lines(const LinesOfCode& before, LinesOfCode now);

}  // namespace porttool

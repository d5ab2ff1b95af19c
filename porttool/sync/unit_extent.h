// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/scan/unit.h"

namespace porttool {

/// A unit as a person would cut it out of its file.
struct UnitExtent {
    TokenRange tokens;   ///< with the `;` after it, and the `typedef` before it
    size_t comment = 0;  ///< where the comment above it begins, at the start of a line; without one where the code does
    size_t code = 0;     ///< its first byte
    size_t end = 0;      ///< after its last line, comments on that included; its line end is not
    bool has_lines = false;  ///< nothing else stands on its lines
};
UnitExtent extent_of(const ScannedFile& file, const Unit& unit);

/// The blanks that the line of a byte begins with.
std::string indent_at(const LexedText& text, size_t offset);

/// How many blank lines stand before a line's start, or after a line's end; at most 2.
size_t blank_lines_above(const LexedText& text, size_t line_start);
size_t blank_lines_below(const LexedText& text, size_t line_end);

/// The preprocessor branches that a token stands in, outermost first, by the lines that opened them; without the guard
/// of a header.
std::vector<uint32_t> branches_around(const ScannedFile& file, uint32_t token);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What of a clause is a value, and where one value ends.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "porttool/compare/alignment.h"

namespace porttool {

/// A name, of which more is known than that it is a word: no type and no keyword.
bool is_name(const std::string& word);

/// `.`, `->` or `::`.
bool is_accessor(const std::string& word);

/// True for a word that makes another value of the one before it: a member, an element, what it gives back.
bool goes_on(const std::string& word);

/// True if words [first, end) lead to the word after them: `consts -> params .`.
bool is_path(const std::vector<std::string>& words, size_t first, size_t end);

/// True if words [first, end) are one operand, whatever stands beside them: a name, a call, something in parentheses.
bool is_operand(const std::vector<std::string>& words, size_t first, size_t end);

/// Where the bracket that opens at `open` closes, before `end`; else `end`.
size_t closing_bracket(const std::vector<std::string>& words, size_t open, size_t end);

/// The words of a clause that make its value: of `a = b + c ;` and of `return b + c ;` the sum.
Clause value_of(const std::vector<std::string>& words, Clause clause);

/// The only clause of a text that gives back a value; none if there are several.
std::optional<size_t> only_result(const AlignedText& text);

}  // namespace porttool

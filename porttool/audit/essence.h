// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "porttool/language/dialect.h"

namespace porttool {

/// A statement in the common vocabulary without what sides say differently and mean alike: how a variable is declared,
/// dereferenced or passed, casts, template arguments, the case of names of three letters and more, marks of numbers.
///
///     const float b1 = Dot < 3 > ( d , s1 ) * inv        b1 = dot ( d , s1 ) * inv
///     * b1 = DOT ( d , s1 ) * inv                        the same
std::vector<std::string> essence_of(const std::vector<std::string>& words, const Dialect& dialect);

/// One word of it.
std::string plain_word(const std::string& word, const Dialect& dialect);

/// All words that one side writes, as plain_word() has them.
using WordsOfSide = std::unordered_set<std::string>;

/// What a statement gives: the right side of an assignment to a plain name, or what it returns; else all of it.
std::vector<std::string> value_of(const std::vector<std::string>& words);

/// What a change from one statement to another may matter to a side with this vocabulary, 0 to 1: numbers, operators
/// and names that are known there count, and are held against names that nobody there knows; types, brackets, another
/// variable for the same value, and another way to it do not.
float substance_of(const std::vector<std::string>& before, const std::vector<std::string>& now,
                   const WordsOfSide& there);

/// True for variables that are declared and get no value.
bool is_bare_declaration(const std::vector<std::string>& written);

/// True for a statement that speaks to people or to the build: it prints, logs, asserts, or is a preprocessor line.
bool is_aside(const std::vector<std::string>& words);

}  // namespace porttool

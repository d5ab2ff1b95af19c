// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "porttool/compare/clauses.h"
#include "porttool/language/dialect.h"

namespace porttool {

/// A text to lay beside another: its words, its clauses, and what each word goes by.
struct AlignedText {
    const std::vector<std::string>& words;
    std::vector<Clause> clauses;
    std::vector<uint32_t> exact;   ///< one number a spelling
    std::vector<uint32_t> common;  ///< one number a common word; equal for numbers of one value
};

/// Numbers words, so that those of several texts can be held against each other.
class WordKeys {
public:
    explicit WordKeys(const Dialect& dialect) : dialect_(dialect) {}

    AlignedText text(const std::vector<std::string>& words, bool is_record);
    uint32_t exact(std::string_view word) { return number(word); }
    const Dialect& dialect() const { return dialect_; }

private:
    uint32_t number(std::string_view word);

    const Dialect& dialect_;
    std::unordered_map<std::string, uint32_t> numbers_;
    std::unordered_map<uint32_t, uint32_t> common_;  ///< by exact number
};

/// Which clause and which word of one text stands for which of another.
struct Alignment {
    static constexpr size_t kNone = static_cast<size_t>(-1);

    std::vector<size_t> clause_of;  ///< for each clause of the first text one of the second, or kNone
    std::vector<size_t> word_of;    ///< the same of words
    std::vector<double> likeness;   ///< of each clause and its counterpart, 0 to 1
};

/// How much alike clauses must be to stand for each other, 0 to 1, and whether names may differ throughout.
struct AlignmentRule {
    double least = 0.3;
    bool learns_names = true;
};

/// Lays two texts side by side, in order: clauses first, then the words of each pair of clauses. Where names differ
/// throughout (`dir` is `local_dir` there) that is learned from the clauses that are alike otherwise. Texts that are
/// too long to compare have no counterparts.
Alignment align(const AlignedText& first, const AlignedText& second, const AlignmentRule& rule);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "porttool/compare/alignment.h"
#include "porttool/sync/brace_edits.h"
#include "porttool/sync/launches.h"
#include "porttool/sync/local_writes.h"
#include "porttool/sync/translator.h"

namespace porttool {

/// Words of the target that others take the place of.
struct WordsReplaced {
    size_t first = 0, end = 0;  ///< of the target
    std::vector<CarriedWord> words;
    size_t source_first = 0, source_end = 0;  ///< what they were made from, in the source's new text
};

/// A clause that the target gets.
struct ClauseAdded {
    std::vector<CarriedWord> words;
    size_t source = 0;     ///< the clause of the source's new text
    bool is_wait = false;  ///< a wait of the port's own before that clause
};

/// Clauses that come before a word of the target, where one of its clauses begins.
struct ClausesAdded {
    size_t before = 0;
    std::vector<ClauseAdded> clauses;
};

/// Something that a person must do.
struct LeftOver {
    std::string message;
    size_t source_word = 0, target_word = 0;  ///< in the source's new text, in the target; about where
    size_t statements = 1;                    ///< of the source that it tells of
    bool is_sure = true;                      ///< false where the place is that of the nearest neighbour alone
    size_t was = Alignment::kNone;            ///< the clause of the source's old text that went, where one did
};

/// What the target's text has to become.
struct Transplant {
    std::vector<WordsReplaced> replaced;
    std::vector<ClausesAdded> added;
    std::vector<size_t> removed;  ///< clauses
    std::vector<LeftOver> left;
    /// For each clause of the source's new text the clause of the target that stands for it, or Alignment::kNone.
    std::vector<size_t> stands_for;
    BraceEdits braces;
    size_t already = 0;  ///< edits that the target has
    size_t size() const { return replaced.size() + added.size() + removed.size(); }
    bool empty() const { return size() == 0; }
    /// How many statements are left.
    size_t left_size() const {
        return std::accumulate(left.begin(), left.end(), size_t{0},
                               [](size_t sum, const LeftOver& one) { return sum + one.statements; });
    }
};

/// The three texts that an edit is carried by, and how they stand for each other.
struct EditTexts {
    const AlignedText &before, &now, &target;
    const Alignment& edit;                            ///< before -> now
    const Alignment& across;                          ///< before -> target
    const HandsBack &hands_back, &target_hands_back;  ///< of the functions of each side
    const std::set<size_t>& paragraphs;               ///< words of now that an empty line stands before
    const std::vector<LaunchPair>& launches;          ///< of before, with those of target
};

/// Carries the source's edit before -> now into the target: each changed word to the words that stand for it there,
/// each new clause to between the counterparts of its neighbours. What has no sure place, or no sure words, is left.
/// `written`: how the source writes each word of its new text. `is_method`: the target's unit sees the fields of a
/// class.
Transplant transplant(const EditTexts& texts, const EditTranslator& translator,
                      const std::function<std::string(size_t)>& written, bool is_method);

}  // namespace porttool

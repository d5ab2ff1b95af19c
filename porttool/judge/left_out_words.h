// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "porttool/judge/finding_list.h"
#include "porttool/judge/harmless_macros.h"
#include "porttool/judge/judge.h"
#include "porttool/judge/told_once.h"
#include "porttool/normal/word_macros.h"

namespace porttool {

/// Finds the pairs of which a side says something else since a word means something new that the comparison leaves out
/// or takes for another one, whether the unit was edited or not:
///
///     now also  #define register static
///     as ever   int count() { register int n = 0; return ++n; }
///
/// What was said at the merge base tells what is new: without one nothing is found. Of harmless forms nothing is told.
class LeftOutWords {
public:
    /// All must outlive it.
    LeftOutWords(const Case& facts, const Dialect& dialect, FindingList& findings)
        : facts_(facts), dialect_(dialect), findings_(findings) {}

    /// Adds the findings of a pair. Of several pairs that use one such word the first tells. `is_told`: the pair has a
    /// finding that is more than a note.
    void judge(const JudgedPair& pair, bool is_told);

    /// Says in each finding how many more pairs there are. After all pairs.
    void tell_how_many();

private:
    struct Place {
        const ScannedFile* file = nullptr;
        const Unit* unit = nullptr;
    };
    /// Something said of a word that may be harmful, or said of one that a macro of that word names.
    struct Said {
        const NewWord* what = nullptr;
        bool is_within = false;
    };
    /// A word of a unit that means something else now.
    struct Changed {
        Said said;
        std::string_view word;  ///< that the unit has
    };
    /// How a word stands in a unit, as far as that decides what is harmful.
    struct Standing {
        std::string_view word;
        LeftOutAs as;
        bool in_body;
        bool has_plain_rest;  ///< all arguments but the first do nothing by themselves
        auto operator<=>(const Standing&) const = default;
    };
    /// Of one side, filled when first asked.
    struct SideWords {
        std::unordered_map<std::string_view, std::vector<const NewWord*>> by_word;  ///< what is said of words
        std::unordered_map<std::string_view, std::vector<NewWord>> macros;          ///< all that the side has now
        std::unordered_map<std::string_view, std::vector<std::string_view>> names;  ///< macros that these name
        std::unordered_map<std::string, Place> places;                              ///< of units, by their ids
        std::map<Standing, std::vector<Said>> harmful;                              ///< filled when first asked
    };

    SideWords& words(Side side);
    static void add_names(SideWords& words);
    std::vector<Changed> changed_in(const JudgedPair& pair, Side side, bool is_told);
    const std::vector<Said>& harmful(Side side, const Standing& standing);
    bool is_harmful(const SideWords& all, const Said& said, const Standing& standing) const;
    bool is_seen(Side side, const NewWord& said, const UnitState& user);
    void tell(const JudgedPair& pair, Side side, const Changed& changed);

    const Case& facts_;
    const Dialect& dialect_;
    FindingList& findings_;
    BySide<std::optional<SideWords>> words_;
    BySide<std::optional<WordMacros>> includes_;  ///< filled where it is asked who includes whom
    ToldOnce told_;
};

}  // namespace porttool

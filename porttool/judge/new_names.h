// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "porttool/judge/finding_list.h"
#include "porttool/judge/judge.h"
#include "porttool/judge/overloads.h"
#include "porttool/judge/told_once.h"
#include "porttool/normal/word_macros.h"

namespace porttool {

/// Finds the pairs of which a side says something else, unedited, since a word of it means something that is new there:
///
///     now also  float sqrtf(float x) { return x; }
///     as ever   float length(float x, float y) { return sqrtf(x * x + y * y); }
///
/// New is a unit under a name that came from elsewhere before, in a nearer namespace, as an overload that competes with
/// one that is called, or as a second definition of what is used or paired, under another `#if`; a constructor, an
/// assignment or a conversion of a type that is used; an alias, a variable, a `using` of the word outside of units.
/// Where units must have a counterpart, new ones are told as such (judge/unwatched.h), and only what stands outside of
/// units is here. What was there at the merge base tells what is new: without one nothing is found.
class NewNames {
public:
    /// Both must outlive it.
    NewNames(const Case& facts, FindingList& findings) : facts_(facts), findings_(findings) {}

    /// Adds the findings of a pair. Of several pairs that use one such word the first tells.
    void judge(JudgedPair& pair);

    /// Says in each finding how many more pairs there are. After all pairs.
    void tell_how_many();

private:
    /// Why a word means something else.
    enum class Reason : uint8_t { Taken, Hidden, Competes, Doubled, Special, Said, Opened };
    struct Meaning {
        std::string word;  ///< what is used
        Reason reason = Reason::Taken;
        const UnitState* unit = nullptr;  ///< one of both
        const NewWord* said = nullptr;
        Signature signature = {};
        bool stands_for_unit = false;  ///< `said` may take the place of a unit of that name
    };
    /// Where a namespace is opened that was not.
    struct OpenedIn {
        std::map<std::string_view, const NewWord*> by_file;
        const NewWord* header = nullptr;
    };
    /// What is new on a side, by the words that may mean it.
    struct Fresh {
        std::vector<Meaning> meanings;
        std::unordered_multimap<std::string_view, const Meaning*> by_word;
        std::unordered_multimap<std::string_view, const Meaning*> by_name;  ///< that may take the place of a unit
        std::set<std::string> opened;                                       ///< namespaces
        std::map<std::string, OpenedIn, std::less<>> opened_now;
    };
    using Uses = std::set<const Meaning*>;  ///< in the order of `meanings`

    const Fresh& fresh(Side side);
    void add_units(Side side, Fresh& out) const;
    void add_words(Side side, Fresh& out) const;
    static std::optional<Reason> beside(const Signature& own, const Signature& one, const Fresh& out);
    Uses uses_of(Side side, const UnitState& user, const NormalText& text) const;
    bool means(Side side, const Meaning& meaning, const UnitState& user, const NormalText& text, size_t at) const;
    static bool is_seen(const std::string& scope, const UnitState& user, const Fresh& fresh);
    const NewWord* opened_for(Side side, const Meaning& meaning, const UnitState& user) const;
    bool is_included(Side side, const std::string& file, const UnitState& user) const;
    bool sees_definition(Side side, const Meaning& meaning, const UnitState& user) const;
    bool defines(Side side, const Meaning& meaning, const UnitState& unit) const;
    Uses changed_uses(const JudgedPair& pair, Side side);
    void tell(JudgedPair& pair, Side side, const Meaning& meaning);
    static std::string change_of(const Meaning& meaning, const NewWord* said);

    const Case& facts_;
    FindingList& findings_;
    BySide<std::optional<Fresh>> fresh_;
    mutable BySide<std::optional<WordMacros>> includes_;  ///< filled where it is asked who includes whom
    ToldOnce told_;
};

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/judge/finding_list.h"
#include "porttool/judge/judge.h"
#include "porttool/judge/shared_files.h"
#include "porttool/judge/told_once.h"
#include "porttool/judge/watched_units.h"
#include "porttool/normal/word_macros.h"

namespace porttool {

/// Finds the pairs of which one side says something else since macros came, went or changed, while its own text, as
/// recorded, has their names as words; or since what its files declare of its words did, where no pair watches that: a
/// constant, an enumerator, a type's other name, a block of variables; or since locals were renamed to what macros are
/// called or read. The first pair of those that the same macros
/// changed tells of it.
class MacroEdits {
public:
    /// All must outlive it.
    MacroEdits(const Case& facts, SharedFiles& shared_files, FindingList& findings)
        : facts_(facts), findings_(findings), shared_files_(shared_files), watched_(facts.map) {}

    /// Adds the finding of a pair, if there is one. `line`: the pair's in the lock, or nullptr. One that does not say
    /// what macros made of the texts then is older than this question.
    void judge(JudgedPair& pair, const LockedPair* line);

    /// Says in each finding how many more pairs there are. After all pairs.
    void tell_how_many();

private:
    std::string edit_of(const JudgedPair& pair, const LockedPair& line, Side side);
    std::string without_shared(const JudgedPair& pair, Side side, const std::string& edit);
    std::string declared_edit(const JudgedPair& pair, const LockedPair& line, Side side);
    bool leads_to(const UnitState& unit, Side side, std::string_view word);
    bool is_told_elsewhere(Side side, const WordMacro& declared);
    std::multiset<std::string> values_of(const JudgedPair& pair, Side side, const std::string& edit);
    bool say_the_same(const JudgedPair& pair, const BySide<std::string>& edits);
    bool stand_for_each_other(const JudgedPair& pair, const BySide<std::string>& edits) const;
    std::string now_of(const JudgedPair& pair, const LockedPair& line, Side side);
    void tell_unlike_numbers(JudgedPair& pair, const LockedPair& line);
    void tell_caught_locals(JudgedPair& pair, const LockedPair& line);
    std::optional<WordMacro> macro_with(const UnitState& unit, Side side, std::string_view name);
    std::vector<std::string_view> words_of(Side side, const WordMacro& macro);
    void tell(JudgedPair& pair, Side side, const std::string& edit);
    bool is_told_by_edit(const JudgedPair& pair, const Finding& of_macros) const;
    WordMacros& macros(Side side);

    const Case& facts_;
    FindingList& findings_;
    SharedFiles& shared_files_;
    BySide<std::optional<WordMacros>> macros_;
    /// Constants and structs by their files; filled when first asked.
    BySide<std::optional<std::multimap<std::string_view, const UnitState*>>> declaring_;
    WatchedUnits watched_;
    /// Macros that are units, by where they begin; filled when first asked.
    BySide<std::optional<std::map<std::pair<std::string, uint32_t>, const UnitState*>>> at_place_;
    ToldOnce told_;  ///< by the edit
};

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "porttool/judge/finding_list.h"
#include "porttool/judge/judge.h"
#include "porttool/normal/word_macros.h"

namespace porttool {

/// Finds the pairs of which one side says something else since macros came, went or changed, while its own text, as
/// recorded, has their names as words. The first pair of those that the same macros changed tells of it.
class MacroEdits {
public:
    /// Both must outlive it.
    MacroEdits(const Case& facts, FindingList& findings) : facts_(facts), findings_(findings) {}

    /// Adds the finding of a pair, if there is one. `line`: the pair's in the lock, or nullptr. One that does not say
    /// what macros made of the texts then is older than this question.
    void judge(JudgedPair& pair, const LockedPair* line);

    /// Says in each finding how many more pairs there are. After all pairs.
    void tell_how_many();

private:
    struct Told {
        std::string fingerprint;
        size_t more = 0;
    };

    std::string edit_of(const JudgedPair& pair, const LockedPair& line, Side side);
    void tell(JudgedPair& pair, Side side, const std::string& edit);
    bool is_told_by_edit(const JudgedPair& pair, const Finding& of_macros) const;
    WordMacros& macros(Side side);

    const Case& facts_;
    FindingList& findings_;
    BySide<std::optional<WordMacros>> macros_;
    std::map<std::string, Told> told_;  ///< by the edit
};

}  // namespace porttool

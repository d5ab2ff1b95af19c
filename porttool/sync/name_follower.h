// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "porttool/sync/drafts.h"
#include "porttool/sync/knowledge.h"
#include "porttool/sync/proposal.h"

namespace porttool {

/// Gives a function of the port the new name that its original got, where both had one name before: in its head and in
/// all calls, for a pair of which that is the whole edit. The pair of the function itself is found under the new name.
///
///     source    float sigmoidf ( float x )     was sigmoid        port    float sigmoid ( float x )     becomes
///     sigmoidf
class NameFollower {
public:
    /// All must outlive it.
    NameFollower(const CheckedProject& checked, Knowledge& knowledge, Drafts& drafts);

    /// A pair whose edit of the side `from` is due nowhere, as far as texts tell.
    void note(const JudgedPair& pair, Side from);
    /// What became of these, when all else is proposed; patches come last.
    void run(std::vector<Proposal>& proposals);

private:
    struct Name {
        const JudgedPair* pair = nullptr;  ///< of the function
        std::string old, now;
        auto operator<=>(const Name&) const = default;
    };
    struct Wish {
        const JudgedPair* pair;
        Side from;
        std::set<Name> names;
    };
    bool follow(const Name& name, Side to);
    bool has_word(Side side, const std::string& path, const std::string& word) const;

    const CheckedProject& checked_;
    Knowledge& knowledge_;
    Drafts& drafts_;
    BySide<std::vector<Name>> renamed_;
    std::vector<Wish> wishes_;
};

}  // namespace porttool

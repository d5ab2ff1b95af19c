// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/read/target_sets.h"
#include "porttool/sync/drafts.h"
#include "porttool/sync/earlier_files.h"
#include "porttool/sync/knowledge.h"
#include "porttool/sync/record_draft.h"

namespace porttool {

/// Units that came to one side without a counterpart, and the ports that this run makes of them: what uses them cannot
/// be ported before they are.
class NewUnits {
public:
    /// All must outlive it. `brought`: names that other edits of the run bring in.
    NewUnits(const CheckedProject& checked, const EarlierFiles& earlier, Knowledge& knowledge, Drafts& drafts,
             RecordDraft& record, const std::set<std::string, std::less<>>& brought)
        : checked_(checked),
          earlier_files_(earlier),
          record_(record),
          knowledge_(knowledge),
          drafts_(drafts),
          brought_(brought),
          sets_(checked.project.map) {}

    /// Ports those that a text uses and that its port can use; those in `excluded` stay without.
    void port(const std::vector<std::string>& words, const JudgedPair& user, Side from,
              const std::set<std::string>& excluded);

    /// The names of all that have no port which `user` could use, each with the reason where one was tried.
    std::map<std::string, std::string, std::less<>> unported(Side from) const;

    /// The name of one that no port was made of; "" if there is none.
    std::string still_alone(Side from) const;

    /// The fields and enumerators of those that the user can use, and what other edits of the run bring in.
    std::set<std::string, std::less<>> brought() const;

    /// How many were ported so far; all after that are forgotten. The drafts are taken back by themselves.
    size_t count() const { return made_.size(); }
    void take_back(size_t count);

    /// The names of those from `first` on that neither `words`, a text of the port, nor another of them uses.
    std::set<std::string> unused(size_t first, const std::vector<std::string>& words) const;
    /// What a reader is told of those from `first` on.
    std::vector<std::string> told(size_t first) const;

private:
    struct Made {
        Side from;
        FreshPair pair;
        std::string name, port_name, target_set;
        std::set<std::string> uses;                      ///< other new units, by their names
        std::set<std::string, std::less<>> fields = {};  ///< of a struct
        bool is_twin = false;                            ///< the port had it already
        const UnitState& unit() const { return from == Side::Source ? pair.source : pair.target; }
        const UnitState& port() const { return from == Side::Source ? pair.target : pair.source; }
    };
    struct Wanted;

    /// By name; several where a name is overloaded.
    const std::map<std::string, std::vector<const UnitState*>, std::less<>>& fresh_units(Side from) const;
    void find_since_commit(Side from, std::map<std::string, std::vector<const UnitState*>, std::less<>>& out) const;
    std::string port_one(const std::string& name, const JudgedPair& user, Side from, std::set<std::string>& open);
    std::string write(const Wanted& wanted);
    std::string settle(const Wanted& wanted, Draft& draft, const std::string& now, const std::string& port_name,
                       const std::set<std::string>& uses);
    std::vector<const ScannedFile*> places(const UnitState& unit, const JudgedPair& user, Side from) const;
    void read_names(Side side);
    const UnitState* twin_of(const std::string& name, const JudgedPair& user, Side from);
    std::string take_twin(const std::string& name, const UnitState& twin, Side from);
    std::string record_made();
    std::string possible_counterpart(const Wanted& wanted, const std::string& port_name);
    bool can_be_used(const Made& made, const JudgedPair& user);
    void tell_knowledge();

    const CheckedProject& checked_;
    const EarlierFiles& earlier_files_;
    RecordDraft& record_;
    Knowledge& knowledge_;
    Drafts& drafts_;
    const std::set<std::string, std::less<>>& brought_;
    TargetSets sets_;
    mutable BySide<std::map<std::string, std::vector<const UnitState*>, std::less<>>> fresh_;
    mutable BySide<bool> fresh_read_{};
    BySide<std::map<std::string, std::vector<const UnitState*>, std::less<>>> by_name_;  ///< all units of a side
    BySide<std::map<std::string, std::vector<const UnitState*>, std::less<>>> by_file_;
    std::vector<Made> made_;
    /// Of those that could not be ported for this user, and could not before some were excluded.
    std::map<std::string, std::string, std::less<>> reasons_, earlier_;
    std::set<std::string> excluded_;
    std::set<std::string, std::less<>> usable_;  ///< by this user
};

}  // namespace porttool

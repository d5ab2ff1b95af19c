// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/read/target_sets.h"
#include "porttool/sync/call_sites.h"
#include "porttool/sync/drafts.h"
#include "porttool/sync/knowledge.h"
#include "porttool/sync/proposal.h"

namespace porttool {

/// Brings new parameters to the declarations of a port and to calls that no pair covers, and tells of calls that were
/// left behind.
class CallCarrier {
public:
    /// All must outlive it.
    CallCarrier(const CheckedProject& checked, Knowledge& knowledge, Drafts& drafts);

    /// Before an edit is carried: how the port's head is. `before`: the source's earlier text.
    void begin(const JudgedPair& pair, Side from, const NormalText& before);
    /// After it: what its head gained goes to where it is declared, and to calls where the argument is certain.
    void carry(const JudgedPair& pair, Side from, const NormalText& before);

    /// When all is carried: calls that give as many arguments as a function took before are left, and new ones of a
    /// function whose own port is left. `pairs`: of the proposals, by their places in the judgement.
    void tell(const std::vector<size_t>& pairs, std::vector<Proposal>& proposals);
    /// Functions that give nothing back, and of which a part of a port takes a value.
    const Valueless& valueless() const { return valueless_; }

private:
    /// A function that takes another number of arguments now, on the side that is written.
    struct Changed {
        const JudgedPair* pair;
        Side from;
        size_t old_count, new_count;
    };
    using Places = std::map<size_t, size_t>;  ///< of proposals, by those of their pairs
    struct Added {
        size_t place;  ///< among the parameters before
        std::string parameter, argument;
    };

    std::vector<std::string> parameters_now(const JudgedPair& pair, Side to);
    const UnitState* only_one(Side side, const std::string& file, const std::string& name);
    bool is_only_one(const JudgedPair& pair, Side side);
    std::string certain_argument(const JudgedPair& pair, Side from, size_t count, size_t place);
    void edit_sites(const JudgedPair& pair, Side to, size_t old_count, const std::vector<Added>& added);
    template <class Take>
    void each_site(const JudgedPair& pair, Side side, const Take& take);
    void tell_old_calls(const Changed& one, const Places& places, std::vector<Proposal>& proposals);
    using Calls = std::set<std::pair<std::string, size_t>>;  ///< functions, and with how many arguments
    Calls misfitting_calls(const ScannedFile& file, const Unit& unit, Side side);
    bool is_out_of_step(Side side, const std::string& id) const;
    bool takes(const UnitState& function, Side side, size_t count);
    void tell_misfits(const JudgedPair& pair, Side from, Proposal& proposal);
    /// Whether a function gives nothing back, as its file stands or (`by_now`) as the patches so far have left it.
    bool gives_nothing(const UnitState& function, Side side, bool by_now);
    /// How often a unit takes the value of each function that gave none.
    std::map<const UnitState*, size_t> values_taken(const ScannedFile& file, const Unit& unit, Side side);
    void tell_values_of_nothing(const JudgedPair& pair, Side from, const Places& places,
                                std::vector<Proposal>& proposals);
    void tell_early_calls(const Changed& one, const Places& places, std::vector<Proposal>& proposals);
    bool is_paired(Side side, const std::string& id) const { return paired_[side].contains(id); }

    const CheckedProject& checked_;
    Knowledge& knowledge_;
    Drafts& drafts_;
    TargetSets sets_;
    BySide<std::map<std::string, std::vector<size_t>>> paired_;                     ///< the pairs of a unit, by its id
    BySide<std::map<std::pair<std::string, std::string>, const UnitState*>> only_;  ///< by port and name; or nullptr
    std::vector<std::string> before_;
    std::map<const JudgedPair*, Side> from_;  ///< the side that a pair is carried from
    std::vector<Changed> changed_;            ///< by proposals
    std::vector<Changed> wanted_;             ///< by edits of the source
    Valueless valueless_;
};

}  // namespace porttool

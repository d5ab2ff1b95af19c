// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What was copied from a neighbour and not changed in all places: one text tells, whatever the other side has.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/audit/past_walk.h"
#include "porttool/snapshot/snapshot.h"

namespace porttool {

/// A member of another group among those of one.
struct OddMember {
    std::string group, member;  ///< as they stand there
    std::string wanted;         ///< the group of all others, which has that member, too

    bool operator==(const OddMember&) const = default;
};

/// What the units of both sides read of groups, and which members stand oddly among those of an arm of a `switch`.
///
/// A unit whose name has a group's in it is about that group, too.
///
///     case kMirror : kr = f ( m . mirror . kr ) ; bump = m . mirror . bump ;
///     case kGlass :  kr = f ( m . glass . kr ) ; kt = f ( m . glass . kt ) ; n = m . glass . n ; bump = m . mirror .
///     bump ;
class OddMembersOfSides {
public:
    /// What it is given has to stay.
    OddMembersOfSides(const Lineages& lineages, const States& states);

    /// Those of one unit, each once.
    std::vector<OddMember> of(const std::string& id) const;

private:
    void add_odd_in_arms(const std::string& id, std::vector<OddMember>& out) const;
    void add_odd_by_name(const std::string& id, std::vector<OddMember>& out) const;
    bool knows_all(const std::string& group, const std::vector<std::string>& members) const;

    const Lineages& lineages_;
    std::map<std::string, std::set<std::string>> members_;  ///< by group, which is a member itself
    std::map<std::string, std::set<std::string>> about_;    ///< by file the groups that some arm is about
    std::map<std::string, std::set<std::string>> named_;    ///< by file the groups that some unit goes by the name of
};

}  // namespace porttool

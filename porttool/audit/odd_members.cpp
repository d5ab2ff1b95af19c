// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/odd_members.h"

#include <algorithm>
#include <utility>

#include "porttool/normal/declaration_words.h"
#include "porttool/normal/statements.h"
#include "porttool/scan/scan.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

constexpr size_t kAGroup = 3;  ///< so many members of one are no chance

/// `m . glass . kd` of a statement.
struct Way {
    std::string root, group, member;
};

bool joins(const std::string& word) { return word == "." || word == "->"; }

std::vector<Way> ways_of(const std::vector<WrittenStatement>& statements, size_t first, size_t end) {
    std::vector<Way> out;
    for (size_t s = first; s < end; ++s) {
        const std::vector<std::string> words = words_of_statement(statements[s]);
        for (size_t i = 0; i + 4 < words.size(); ++i) {
            const bool begins = i == 0 || !(joins(words[i - 1]) || words[i - 1] == "::");
            if (begins && is_word_token(words[i]) && joins(words[i + 1]) && is_word_token(words[i + 2]) &&
                joins(words[i + 3]) && is_word_token(words[i + 4]) && (i + 5 == words.size() || words[i + 5] != "("))
                out.push_back({words[i], words[i + 2], words[i + 4]});
        }
    }
    return out;
}

/// Where the arms of all switches begin and end. A unit that has none may mix groups as it likes.
std::vector<std::pair<size_t, size_t>> arms_of(const std::vector<WrittenStatement>& statements) {
    std::vector<size_t> labels;
    const auto is_label = [&](size_t i) {
        const std::vector<std::string> words = words_of_statement(statements[i]);
        return !words.empty() && is_one_of(words[0], {"case", "default"});
    };
    for (size_t i = 1; i < statements.size(); ++i)
        if (is_label(i) && !is_label(i - 1)) labels.push_back(i);
    std::vector<std::pair<size_t, size_t>> out;
    const auto leaves = [&](size_t i) {
        const std::vector<std::string> words = words_of_statement(statements[i]);
        return !words.empty() && is_one_of(words[0], {"break", "return"});
    };
    for (size_t k = 0; k < labels.size(); ++k) {
        size_t end = labels[k];
        const size_t next = k + 1 < labels.size() ? labels[k + 1] : statements.size();
        while (end < next && !leaves(end)) ++end;
        out.emplace_back(labels[k], std::min(end + 1, next));  // what stands behind the last arm is no part of it
    }
    return out;
}

/// The members that one arm reads of each group of one root.
using GroupsOfRoot = std::map<std::string, std::vector<const Way*>>;

std::map<std::string, GroupsOfRoot> by_root(const std::vector<Way>& ways) {
    std::map<std::string, GroupsOfRoot> out;
    for (const Way& way : ways) out[way.root][way.group].push_back(&way);
    return out;
}

size_t members_in(const std::vector<const Way*>& ways) {
    std::set<std::string> out;
    for (const Way* way : ways) out.insert(way->member);
    return out.size();
}

/// The groups that arms are about.
std::set<std::string> groups_it_is_about(const std::vector<WrittenStatement>& statements) {
    constexpr size_t kFewest = 2;
    std::set<std::string> out;
    for (const auto& [first, end] : arms_of(statements)) {
        const std::vector<Way> ways = ways_of(statements, first, end);
        for (const auto& [root, groups] : by_root(ways))
            if (groups.size() == 1 && members_in(groups.begin()->second) >= kFewest) out.insert(groups.begin()->first);
    }
    return out;
}

/// True for a unit whose name has that of a group in it: `BlenderWoodTexture_Eval` and `blenderWood`.
bool goes_by(const std::string& unit, const std::string& group) {
    constexpr size_t kTelling = 4;
    return group.size() >= kTelling && folded(unit).find(folded(group)) != std::string::npos;
}

}  // namespace

OddMembersOfSides::OddMembersOfSides(const Lineages& lineages, const States& states) : lineages_(lineages) {
    for (const Side side : kBothSides)
        for (const auto& [id, unit] : states[side])
            if (const auto lineage = lineages.find(id); lineage != lineages.end()) {
                const std::vector<WrittenStatement>& today = lineage->second.today();
                for (const Way& way : ways_of(today, 0, today.size())) members_[way.group].insert(way.member);
                about_[unit.file].merge(groups_it_is_about(today));
                for (const Way& way : ways_of(today, 0, today.size()))
                    if (goes_by(split_id(id).second, way.group)) named_[unit.file].insert(way.group);
            }
}

void OddMembersOfSides::add_odd_in_arms(const std::string& id, std::vector<OddMember>& out) const {
    const auto lineage = lineages_.find(id);
    const auto about = about_.find(split_id(id).first);
    if (lineage == lineages_.end() || about == about_.end()) return;
    const std::vector<WrittenStatement>& today = lineage->second.today();
    for (const auto& [first, end] : arms_of(today)) {
        const std::vector<Way> ways = ways_of(today, first, end);
        for (const auto& [root, groups] : by_root(ways)) {
            if (groups.size() != 2) continue;
            const auto &one = *groups.begin(), &two = *std::next(groups.begin());
            const bool one_leads = members_in(one.second) > members_in(two.second);
            const auto &leads = one_leads ? one : two, &odd = one_leads ? two : one;
            const auto known = members_.find(leads.first);
            if (members_in(leads.second) < kAGroup || 2 * members_in(odd.second) > members_in(leads.second) ||
                !about->second.contains(odd.first) || known == members_.end())
                continue;
            const auto is_meant_for = [&](const Way* way) {
                return known->second.contains(way->member) &&
                       std::none_of(leads.second.begin(), leads.second.end(),
                                    [&](const Way* own) { return own->member == way->member; });
            };
            if (!std::all_of(odd.second.begin(), odd.second.end(), is_meant_for)) continue;
            for (const Way* way : odd.second) {
                OddMember found{way->group, way->member, leads.first};
                if (std::find(out.begin(), out.end(), found) == out.end()) out.push_back(std::move(found));
            }
        }
    }
}

bool OddMembersOfSides::knows_all(const std::string& group, const std::vector<std::string>& members) const {
    const auto known = members_.find(group);
    return known != members_.end() && std::all_of(members.begin(), members.end(),
                                                  [&](const std::string& one) { return known->second.contains(one); });
}

void OddMembersOfSides::add_odd_by_name(const std::string& id, std::vector<OddMember>& out) const {
    const auto lineage = lineages_.find(id);
    const auto [file, name] = split_id(id);
    const auto named = named_.find(file);
    if (lineage == lineages_.end() || named == named_.end()) return;
    const std::vector<WrittenStatement>& today = lineage->second.today();
    const std::vector<Way> ways = ways_of(today, 0, today.size());
    for (const auto& [root, groups] : by_root(ways)) {
        const std::vector<const Way*>* own = nullptr;
        size_t count = 0;
        for (const auto& [group, read] : groups)
            if (goes_by(name, group)) {
                own = &read;
                ++count;
            }
        if (count != 1 || members_in(*own) < kAGroup) continue;
        for (const auto& [group, read] : groups) {
            if (goes_by(name, group) || !named->second.contains(group) || 2 * members_in(read) > members_in(*own))
                continue;
            std::set<std::string> members, of_own;
            for (const Way* way : read) members.insert(way->member);
            for (const Way* way : *own) of_own.insert(way->member);
            const bool reads_both = std::any_of(members.begin(), members.end(),
                                                [&](const std::string& one) { return of_own.contains(one); });
            if (reads_both || !knows_all(own->front()->group, {members.begin(), members.end()})) continue;
            for (const std::string& member : members) out.push_back({group, member, own->front()->group});
        }
    }
}

std::vector<OddMember> OddMembersOfSides::of(const std::string& id) const {
    std::vector<OddMember> out, by_name;
    add_odd_in_arms(id, out);
    add_odd_by_name(id, by_name);
    for (OddMember& one : by_name)
        if (std::find(out.begin(), out.end(), one) == out.end()) out.push_back(std::move(one));
    return out;
}

}  // namespace porttool

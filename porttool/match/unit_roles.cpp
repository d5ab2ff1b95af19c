// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/unit_roles.h"

#include <algorithm>
#include <unordered_map>

#include "porttool/match/words.h"

namespace porttool {
namespace {

uint64_t file_pair(uint32_t a, uint32_t b) { return static_cast<uint64_t>(a) << 32 | b; }

/// Who calls a function of its own file that is such a one.
template <class Is>
std::vector<bool> units_that_call(const std::vector<UnitFeatures>& units, const Is& is) {
    std::unordered_set<uint64_t> such;
    for (const UnitFeatures& unit : units)
        if (unit.group == Group::Code && is(unit)) such.insert(file_pair(unit.file, unit.called_as));
    std::vector<bool> out(units.size());
    for (size_t i = 0; i < units.size(); ++i)
        out[i] = !such.empty() && std::any_of(units[i].callees.begin(), units[i].callees.end(), [&](uint32_t name) {
            return such.contains(file_pair(units[i].file, name));
        });
    return out;
}

}  // namespace

UnitRoles::UnitRoles(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                     const TermNumbers& terms, const std::vector<std::vector<Candidate>>& candidates)
    : source_(source), target_(target), terms_(terms) {
    read_launchers();
    read_workers();
    read_homes(candidates);
}

void UnitRoles::read_homes(const std::vector<std::vector<Candidate>>& candidates) {
    has_home_.assign(source_.size(), false);
    for (uint32_t s = 0; s < source_.size(); ++s)
        has_home_[s] = source_[s].whole_file_main &&
                       std::any_of(candidates[s].begin(), candidates[s].end(), [&](const Candidate& candidate) {
                           const UnitFeatures& unit = target_[candidate.target];
                           return unit.stem == source_[s].stem && unit.works && !prepares(source_[s], unit);
                       });
}

void UnitRoles::read_workers() {
    leads_on_ = units_that_call(source_, [](const UnitFeatures& unit) { return unit.launches && !unit.kernel; });
    delegates_ =
        units_that_call(target_, [](const UnitFeatures& unit) { return unit.works || unit.launches || unit.kernel; });
}

bool UnitRoles::is_idle_for(uint32_t s, uint32_t t) const {
    const UnitFeatures& unit = target_[t];
    return leads_on_[s] && !source_[s].works && !unit.works && !unit.launches && !delegates_[t];
}

void UnitRoles::read_launchers() {
    std::unordered_set<uint32_t> kernels, launchers;
    for (const UnitFeatures& unit : target_)
        if (unit.group == Group::Code) own_.insert(unit.called_as);
    for (const UnitFeatures& unit : source_)
        if (unit.kernel && !own_.contains(unit.called_as)) kernels.insert(unit.called_as);
    launches_.assign(target_.size(), false);
    const auto calls_any = [](const UnitFeatures& unit, const std::unordered_set<uint32_t>& names) {
        return std::any_of(unit.callees.begin(), unit.callees.end(),
                           [&](uint32_t name) { return names.contains(name); });
    };
    for (uint32_t t = 0; t < target_.size(); ++t) {
        const UnitFeatures& unit = target_[t];
        // Who sets arguments where there are no kernels sets those of the source's, whatever he stores for that.
        const bool for_others = unit.sets_arguments && !unit.beside_kernels;
        launches_[t] = !unit.kernel && unit.launches && (unit.launcher || for_others || calls_any(unit, kernels));
        if (launches_[t]) launchers.insert(target_[t].called_as);
    }
    for (uint32_t t = 0; t < target_.size(); ++t)
        if (!target_[t].works && calls_any(target_[t], launchers)) launches_[t] = true;
    read_callers();
}

void UnitRoles::read_callers() {
    std::unordered_multimap<uint32_t, uint32_t> launchers;  // by the name that they are called by, their files
    const auto is_one = [&](const UnitFeatures& unit) {
        return unit.group == Group::Code && !unit.kernel && unit.says_kernels && !own_.contains(unit.called_as);
    };
    for (const UnitFeatures& unit : source_)
        if (is_one(unit) && unit.launches) launchers.emplace(unit.called_as, unit.file);
    std::unordered_multimap<uint32_t, uint32_t> handing_on;
    for (const UnitFeatures& unit : source_)
        if (is_one(unit) && !unit.launches)
            for (const uint32_t name : unit.callees)
                if (launchers.contains(name)) handing_on.emplace(unit.called_as, unit.file);
    launchers.insert(handing_on.begin(), handing_on.end());
    calls_into_.assign(target_.size(), {});
    for (uint32_t t = 0; t < target_.size(); ++t)
        if (!target_[t].works && !launchers.empty())
            for (const uint32_t name : target_[t].callees) {
                const auto [first, last] = launchers.equal_range(name);
                for (auto found = first; found != last; ++found) calls_into_[t].insert(found->second);
            }
}

bool UnitRoles::is_launched_there(uint32_t s, uint32_t t) const {
    return is_used_there(s, t) || (source_[s].kernel && (launches_[t] || calls_by_name(s, t)));
}

bool UnitRoles::calls_by_name(uint32_t s, uint32_t t) const {
    const uint32_t name = source_[s].called_as;
    const TermIds& callees = target_[t].callees;
    return !own_.contains(name) && std::binary_search(callees.begin(), callees.end(), name);
}

bool UnitRoles::is_used_there(uint32_t s, uint32_t t) const {
    return calls_into_[t].contains(source_[s].file) && (source_[s].kernel || source_[s].launches);
}

bool UnitRoles::other_role(const UnitFeatures& a, const UnitFeatures& b) {
    const bool one_name =
        a.called_as == b.called_as || (a.folded_leaf == b.folded_leaf && a.names_platform && b.names_platform);
    return a.launcher != b.launcher && (a.kernel || b.kernel || !one_name);
}

bool UnitRoles::prepares(const UnitFeatures& a, const UnitFeatures& b) const {
    if (a.kernel == b.kernel || a.group != Group::Code) return false;
    const UnitFeatures &kernel = a.kernel ? a : b, &other = a.kernel ? b : a;
    return std::any_of(other.all_words.begin(), other.all_words.end(), [&](uint32_t word) {
        return marks_preparation(terms_.text(word)) &&
               !std::binary_search(kernel.all_words.begin(), kernel.all_words.end(), word);
    });
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/new_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_set>

#include "porttool/read/map_file.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

bool may_be_called(const UnitState& unit) {
    if (unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel) return true;
    // Of macros MacroEdits tells.
    return unit.kind == UnitKind::Constant && !unit.text.empty() && unit.text[0] != "#";
}

/// True for a unit that is seen by its bare name from another: both stand in one scope, or it stands in one around
/// that.
bool is_in_scope(const UnitState& unit, const UnitState& user) {
    const size_t end = unit.name.rfind("::");
    return end == std::string::npos || user.name.starts_with(unit.name.substr(0, end + 2));
}

/// How many parts the list has that opens at a place; nothing where it is open at its end or long, or one says `...` or
/// `=`. Calls stand within calls: a list is read once for each of them.
std::optional<size_t> parts_of_list(const NormalText& text, size_t open) {
    constexpr size_t kMostWords = 256;
    const size_t end = std::min(text.size(), open + kMostWords);
    size_t parts = 0;
    bool is_empty = true;
    int depth = 0;
    for (size_t i = open; i < end; ++i) {
        const std::string_view word = text[i];
        if (word == ")" || word == "]" || word == "}") {
            if (--depth == 0) return is_empty ? 0 : parts + 1;
        } else if (i > open) {
            is_empty = false;
        }
        if (word == "(" || word == "[" || word == "{") ++depth;
        if (depth == 1 && word == ",") ++parts;
        if (depth == 1 && (word == "..." || word == "=" || word == "<")) return std::nullopt;
    }
    return std::nullopt;
}

/// False where a call gives a function more or fewer arguments than it takes: it is another overload's.
bool may_take(const UnitState& unit, const NormalText& text, size_t call) {
    size_t head = 0;
    while (head < unit.text.size() && unit.text[head] != "@") ++head;
    if (unit.kind == UnitKind::Constant || head + 1 >= unit.text.size() || unit.text[head + 1] != "(") return true;
    const std::optional<size_t> takes = parts_of_list(unit.text, head + 1), given = parts_of_list(text, call);
    return !takes || !given || *takes == *given;
}

}  // namespace

void NewNames::judge(JudgedPair& pair) {
    for (const Side side : kBothSides) {
        if (facts_.at_base[side] == nullptr || is_contract(facts_.map.reference, side)) continue;
        const UnitState* unit = pair.unit[side];
        if (unit == nullptr || fresh(side).empty()) continue;
        const auto then = facts_.at_base[side]->find(unit->id);
        if (then == facts_.at_base[side]->end()) continue;
        std::set<const UnitState*> found;
        for (size_t i = 0; i + 1 < then->second.text.size(); ++i)
            if (const UnitState* one = called(side, *unit, then->second.text, i)) found.insert(one);
        for (size_t i = 0; i + 1 < unit->text.size() && !found.empty(); ++i)
            if (const UnitState* one = called(side, *unit, unit->text, i); one != nullptr && found.erase(one) > 0)
                tell(pair, side, *one);
    }
}

const NewNames::ByName& NewNames::fresh(Side side) {
    if (fresh_[side]) return *fresh_[side];
    std::unordered_set<std::string_view> known;
    for (const auto& [id, unit] : *facts_.at_base[side]) known.insert(bare_leaf_of(unit.name));
    ByName& out = fresh_[side].emplace();
    for (const auto& [id, unit] : side == Side::Source ? facts_.source : facts_.target)
        if (const std::string_view name = bare_leaf_of(unit.name); may_be_called(unit) && !known.contains(name))
            out.emplace(name, &unit);
    return out;
}

/// The new unit that a text calls by the word at a place.
const UnitState* NewNames::called(Side side, const UnitState& user, const NormalText& text, size_t at) {
    if (text[at + 1] != "(") return nullptr;
    const auto [first, last] = fresh(side).equal_range(text[at]);
    if (first == last) return nullptr;
    const std::string_view before = at > 0 ? text[at - 1] : std::string_view();
    if (before == "." || before == "->" || before == "::") return nullptr;
    const auto found = std::find_if(first, last, [&](const auto& one) {
        return one.second != &user && is_in_scope(*one.second, user) && may_take(*one.second, text, at + 1);
    });
    return found == last ? nullptr : found->second;
}

void NewNames::tell(JudgedPair& pair, Side side, const UnitState& unit) {
    if (const auto known = told_.find(&unit); known != told_.end()) {
        ++known->second.more;
        return;
    }
    Finding& finding = findings_.add(side == Side::Source ? Rule::SourceChanged : Rule::TargetChanged, pair, {}, "",
                                     "new name " + unit.id);
    finding.message = fmt::format("{} says something else, unedited: its call of {} is one of the new {} now",
                                  side == Side::Source ? "the source" : "the port", bare_leaf_of(unit.name), unit.id);
    finding.remedy = "Give it another name; if it is meant so, run: porttool ignore " +
                     argument(pair.id.source + "=" + pair.id.target, finding) + " --reason TEXT";
    told_.emplace(&unit, Told{finding.fingerprint});
}

void NewNames::tell_how_many() {
    for (const auto& [unit, told] : told_) {
        if (told.more == 0) continue;
        for (Finding& finding : findings_.from(0))
            if (finding.fingerprint == told.fingerprint)
                finding.message += fmt::format("; so is that of {} more pair{}", told.more, told.more == 1 ? "" : "s");
    }
}

}  // namespace porttool

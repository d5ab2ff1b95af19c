// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/same_edit_beside.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "porttool/compare/statement_edit.h"
#include "porttool/normal/prelude.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

using Counts = std::map<std::string, size_t>;  ///< statements by their keys

/// The statements that came and those that went; braces follow what they close.
struct KeysOfEdit {
    Counts gained, lost;
    size_t longest = 0;  ///< in words

    explicit KeysOfEdit(const StatementEdit& edit) {
        const auto add = [&](const Statement& statement, Counts& out) {
            if (statement.is_brace()) return;
            ++out[statement.key];
            longest = std::max(longest, statement.common.size());
        };
        for (const size_t i : edit.gained) add(edit.now[i], gained);
        for (const size_t i : edit.lost) add(edit.before[i], lost);
    }
};

/// True if two statements have more than half of their words in common.
bool are_alike(const Statement& a, const Statement& b) {
    std::vector<std::string> left = a.common, right = b.common, both;
    std::sort(left.begin(), left.end());
    std::sort(right.begin(), right.end());
    std::set_intersection(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(both));
    return 2 * both.size() > std::max(left.size(), right.size());
}

/// What the edit took, and what stands beside what it brought in no other's place.
std::vector<const Statement*> places_of(const StatementEdit& edit) {
    std::vector<const Statement*> out;
    for (const size_t i : edit.lost) out.push_back(&edit.before[i]);
    std::vector<bool> is_gone_after(edit.now.size() + 1,
                                    false);  // at a statement's number and one more; 0: at the start
    size_t last = 0;
    for (const size_t now : edit.kept())
        if (now == StatementEdit::kGone)
            is_gone_after[last] = true;
        else
            last = now + 1;
    size_t before = 0;  // the number, and one more, of the last statement that was there before
    for (size_t i = 0, next = 0; i < edit.now.size(); ++i) {
        const bool came = next < edit.gained.size() && edit.gained[next] == i;
        if (came) ++next;
        if (!came) before = i + 1;
        if (!came || is_gone_after[before]) continue;
        if (i > 0) out.push_back(&edit.now[i - 1]);
        if (i + 1 < edit.now.size()) out.push_back(&edit.now[i + 1]);
    }
    return out;
}

/// True if the counterpart says something like the places of the edit: then it is its own that was to be edited.
bool has_its_place(const StatementEdit& edit, const std::vector<Statement>& counterpart) {
    const std::vector<const Statement*> places = places_of(edit);
    return std::any_of(places.begin(), places.end(), [&](const Statement* place) {
        return !place->is_brace() && std::any_of(counterpart.begin(), counterpart.end(),
                                                 [&](const Statement& there) { return are_alike(*place, there); });
    });
}

bool has_all(const Counts& all, const Counts& some) {
    return std::all_of(some.begin(), some.end(), [&](const auto& one) {
        const auto found = all.find(one.first);
        return found != all.end() && found->second >= one.second;
    });
}

bool has_none(const Counts& all, const Counts& some) {
    return std::none_of(some.begin(), some.end(), [&](const auto& one) { return all.contains(one.first); });
}

bool was_edited(const Case& facts, const UnitState& unit, Side side) {
    return std::any_of(facts.lock.baseline.begin(), facts.lock.baseline.end(), [&](const LockedUnit& line) {
        return line.id == unit.id && line.side == side_word(side) && line.prints.renamed != unit.prints.renamed;
    });
}

/// True if a unit's text has that name: it calls what bears it.
bool says(const UnitState& unit, std::string_view name) {
    bool out = false;
    unit.text.each_name([&](std::string_view one) { out = out || one == name; });
    return out;
}

}  // namespace

std::string same_edit_beside(const Case& facts, WatchedUnits& watched, const JudgedPair& pair, Side side,
                             const NormalText& before, const Dialect& dialect) {
    constexpr size_t kSaysSomething = 5;  // words
    const Side there = other(side);
    const UnitState& unit = *pair.unit[side];
    const Translator translator = translated_once([&](const Words& tokens, bool) {
        std::vector<std::string> out;
        for (const std::string_view token : tokens) {
            const std::string* common = dialect.find(token);
            out.push_back(common != nullptr ? *common : std::string(token));
        }
        return out;
    });
    const StatementEdit all_of_it =
        statement_edit(without_prelude(before.words()), without_prelude(unit.text.words()), translator);
    const KeysOfEdit edit(all_of_it);
    if (edit.longest < kSaysSomething) return {};
    if (has_its_place(all_of_it, split_statements(without_prelude(pair.unit[there]->text.words()), translator)))
        return {};
    // Of the units of the one file; who watches it is asked of those that have the edit alone.
    const auto has_the_edit = [&](const UnitState& beside) {
        if (facts.at_base[there] != nullptr) {
            const auto then = facts.at_base[there]->find(beside.id);
            if (then == facts.at_base[there]->end() || then->second.prints.written == beside.prints.written)
                return false;
            const Words now = without_prelude(beside.text.words());
            const KeysOfEdit there_too(statement_edit(without_prelude(then->second.text.words()), now, translator));
            return has_all(there_too.gained, edit.gained) && has_all(there_too.lost, edit.lost);
        }
        if (edit.gained.empty() || !was_edited(facts, beside, there)) return false;
        const KeysOfEdit all(statement_edit({}, without_prelude(beside.text.words()), translator));
        return has_all(all.gained, edit.gained) && has_none(all.gained, edit.lost);
    };
    const UnitState& counterpart = *pair.unit[there];
    const auto work_together = [&](const UnitState& beside) {
        return says(beside, bare_leaf_of(counterpart.name)) || says(counterpart, bare_leaf_of(beside.name));
    };
    const std::string in_file = counterpart.file + ":";
    const auto& units = facts.units(there);
    for (auto at = units.lower_bound(in_file); at != units.end() && at->first.starts_with(in_file); ++at) {
        const UnitState& beside = at->second;
        const bool is_code = beside.kind == UnitKind::Function || beside.kind == UnitKind::Kernel;
        if (is_code && work_together(beside) && has_the_edit(beside) && !watched.contains(there, at->first))
            return at->first;
    }
    return {};
}

}  // namespace porttool

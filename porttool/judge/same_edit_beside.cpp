// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/same_edit_beside.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "porttool/compare/statement_edit.h"
#include "porttool/normal/prelude.h"

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

/// The units of one side that pairs name.
std::set<std::string_view> watched(const Case& facts, Side side) {
    std::set<std::string_view> out;
    for (const MapPair& pair : facts.map.pairs)
        if (side == Side::Source)
            out.insert(pair.source);
        else
            out.insert(pair.targets.begin(), pair.targets.end());
    return out;
}

bool was_edited(const Case& facts, const UnitState& unit, Side side) {
    return std::any_of(facts.lock.baseline.begin(), facts.lock.baseline.end(), [&](const LockedUnit& line) {
        return line.id == unit.id && line.side == side_word(side) && line.prints.renamed != unit.prints.renamed;
    });
}

}  // namespace

std::string same_edit_beside(const Case& facts, const JudgedPair& pair, Side side, const NormalText& before,
                             const Dialect& dialect) {
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
    const std::set<std::string_view> known = watched(facts, there);
    for (const auto& [id, beside] : facts.units(there)) {
        const bool is_code = beside.kind == UnitKind::Function || beside.kind == UnitKind::Kernel;
        if (beside.file != pair.unit[there]->file || !is_code || known.contains(id)) continue;
        const Words now = without_prelude(beside.text.words());
        if (facts.at_base[there] != nullptr) {
            const auto then = facts.at_base[there]->find(id);
            if (then == facts.at_base[there]->end()) continue;
            const KeysOfEdit there_too(statement_edit(without_prelude(then->second.text.words()), now, translator));
            if (has_all(there_too.gained, edit.gained) && has_all(there_too.lost, edit.lost)) return id;
        } else if (was_edited(facts, beside, there)) {
            const KeysOfEdit all(statement_edit({}, now, translator));
            if (!edit.gained.empty() && has_all(all.gained, edit.gained) && has_none(all.gained, edit.lost)) return id;
        }
    }
    return {};
}

}  // namespace porttool

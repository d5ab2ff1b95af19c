// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/block_depth.h"

#include <numeric>
#include <set>

namespace porttool {

namespace {

/// True for the `else` of an `else if`: one block in normal form, but no level of indentation.
bool is_else_of_if(const PlacedUnit& unit, size_t clause) {
    const Clause& head = unit.clauses[clause];
    if (!head.opens || unit.words.words[head.first] != "else" || clause + 1 >= unit.clauses.size()) return false;
    const Clause& next = unit.clauses[clause + 1];
    if (!unit.words.is_added(head.end - 1) || unit.words.words[next.first] != "if") return false;
    if (unit.words.tokens.empty() || unit.words.is_added(head.first) || unit.words.is_added(next.first)) return false;
    const std::vector<Token>& tokens = unit.file.lexed.tokens;
    return tokens[unit.words.tokens[head.first]].line == tokens[unit.words.tokens[next.first]].line;
}

}  // namespace

int BlockDepth::step_in(const PlacedUnit& unit, size_t clause) {
    const Clause& one = unit.clauses[clause];
    if (!one.opens && !one.closes) return 0;
    const size_t head = one.opens ? clause : one.partner;
    if (head != Clause::kNone && is_else_of_if(unit, head)) return 0;
    return one.opens ? 1 : -1;
}

BlockDepth::BlockDepth(const Transplant& transplant, const PlacedUnit& source, const PlacedUnit& target)
    : source_(source), of_clause_(target.clauses.size() + 1, 0), of_new_(transplant.added.size(), 0) {
    // Steps before each clause, then their sums.
    std::vector<int> steps(target.clauses.size() + 1, 0);
    std::vector<size_t> place(transplant.added.size(), 0);
    const std::set<size_t> removed(transplant.removed.begin(), transplant.removed.end());
    for (const size_t clause : removed) steps[clause + 1] -= step_in(target, clause);
    for (size_t batch = 0; batch < place.size(); ++batch) {
        size_t& at = place[batch];
        while (at < target.clauses.size() && target.clauses[at].first < transplant.added[batch].before) ++at;
    }
    std::vector<int> sums = steps;
    for (size_t batch = 0; batch < place.size(); ++batch)
        for (const ClauseAdded& clause : transplant.added[batch].clauses) sums[place[batch]] += step(clause.source);
    std::partial_sum(sums.begin(), sums.end(), of_clause_.begin());
    for (size_t batch = 0; batch < place.size(); ++batch)
        of_new_[batch] = (place[batch] == 0 ? 0 : of_clause_[place[batch] - 1]) + steps[place[batch]];
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/block_ends.h"

#include <algorithm>
#include <set>

#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

namespace {

bool is_else(const AlignedText& text, size_t clause) {
    return clause < text.clauses.size() && text.clauses[clause].opens &&
           text.words[text.clauses[clause].first] == "else";
}

void stand_for(const AlignedText& first, size_t clause, const AlignedText& second, size_t other, Alignment& alignment) {
    const Clause &here = first.clauses[clause], &there = second.clauses[other];
    alignment.clause_of[clause] = other;
    alignment.likeness[clause] = 1.0;
    for (size_t i = 0; i < here.size(); ++i)
        alignment.word_of[here.first + i] = i < there.size() ? there.first + i : Alignment::kNone;
}

/// Words at both ends that are the same stand for each other.
void stand_for_by_ends(const AlignedText& first, size_t clause, const AlignedText& second, size_t other,
                       Alignment& alignment) {
    const Clause &here = first.clauses[clause], &there = second.clauses[other];
    alignment.clause_of[clause] = other;
    alignment.likeness[clause] = 1.0;
    const size_t most = std::min(here.size(), there.size());
    size_t head = 0, tail = 0;
    while (head < most && first.exact[here.first + head] == second.exact[there.first + head]) ++head;
    while (tail < most - head && first.exact[here.end - 1 - tail] == second.exact[there.end - 1 - tail]) ++tail;
    for (size_t i = 0; i < head; ++i) alignment.word_of[here.first + i] = there.first + i;
    for (size_t i = 1; i <= tail; ++i) alignment.word_of[here.end - i] = there.end - i;
}

/// True for `f ( a , b ) ;`.
bool is_call(const AlignedText& text, size_t clause) {
    const Clause& one = text.clauses[clause];
    return !one.opens && !one.closes && one.size() > 3 && is_word_token(text.words[one.first]) &&
           !word_is(text.words[one.first], kKeyword) && text.words[one.first + 1] == "(" &&
           text.words[one.end - 2] == ")" && text.words[one.end - 1] == ";";
}

}  // namespace

void match_only_clauses(const AlignedText& first, const AlignedText& second, Alignment& alignment) {
    if (first.clauses.size() != 1 || second.clauses.size() != 1 || alignment.clause_of[0] != Alignment::kNone) return;
    stand_for_by_ends(first, 0, second, 0, alignment);
}

void match_calls(const AlignedText& first, const AlignedText& second, Alignment& alignment) {
    const std::set<size_t> taken(alignment.clause_of.begin(), alignment.clause_of.end());
    for (size_t c = 1; c + 1 < first.clauses.size(); ++c) {
        const size_t before = alignment.clause_of[c - 1];
        if (alignment.clause_of[c] != Alignment::kNone || before == Alignment::kNone) continue;
        const size_t other = before + 1;
        if (alignment.clause_of[c + 1] != other + 1 || taken.contains(other)) continue;
        if (is_call(first, c) && is_call(second, other) &&
            first.words[first.clauses[c].first] == second.words[second.clauses[other].first])
            stand_for_by_ends(first, c, second, other, alignment);
    }
}

void match_last_else(const AlignedText& first, const AlignedText& second, const UnitWords& now, Alignment& alignment) {
    for (size_t c = 0; c + 1 < first.clauses.size(); ++c) {
        const size_t outer = alignment.clause_of[c];
        if (!is_else(first, c) || outer == Alignment::kNone || !is_else(second, outer)) continue;
        const Clause& head = second.clauses[outer];
        if (!now.is_added(head.end - 1) || outer + 1 >= second.clauses.size() || !second.clauses[outer + 1].opens ||
            second.words[second.clauses[outer + 1].first] != "if")
            continue;
        const size_t branch_end = second.clauses[outer + 1].partner;
        const size_t inner = branch_end == Clause::kNone ? branch_end : branch_end + 1;
        if (inner == Clause::kNone || !is_else(second, inner) || now.is_added(second.clauses[inner].end - 1)) continue;
        const size_t end = second.clauses[inner].partner, old_end = first.clauses[c].partner;
        if (end == Clause::kNone || old_end == Clause::kNone || head.partner != end + 1) continue;
        const std::set<size_t> taken(alignment.clause_of.begin(), alignment.clause_of.end());
        if (taken.contains(inner) || (taken.contains(end) && alignment.clause_of[old_end] != end)) continue;
        const size_t content = alignment.clause_of[c + 1];
        if (content == Alignment::kNone || content <= inner || content >= end) continue;
        stand_for(first, c, second, inner, alignment);
        stand_for(first, old_end, second, end, alignment);
    }
}

void match_block_ends(const AlignedText& first, const AlignedText& second, Alignment& alignment) {
    std::vector<size_t> wanted = alignment.clause_of;
    for (size_t head = 0; head < first.clauses.size(); ++head) {
        const Clause& one = first.clauses[head];
        if (!one.opens || one.partner == Clause::kNone || wanted[head] == Alignment::kNone) continue;
        const size_t end = second.clauses[wanted[head]].partner;
        if (end == Clause::kNone) continue;
        wanted[one.partner] = end;
        // An `else` goes with the end before it.
        if (is_else(first, one.partner + 1) && is_else(second, end + 1)) wanted[one.partner + 1] = end + 1;
    }
    size_t last = Alignment::kNone;
    for (const size_t clause : wanted) {
        if (clause == Alignment::kNone) continue;
        if (last != Alignment::kNone && clause <= last) return;  // in order, or not at all
        last = clause;
    }
    for (size_t clause = 0; clause < wanted.size(); ++clause)
        if (wanted[clause] != alignment.clause_of[clause]) stand_for(first, clause, second, wanted[clause], alignment);
}

}  // namespace porttool

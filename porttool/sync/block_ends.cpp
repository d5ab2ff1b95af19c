// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/block_ends.h"

#include <algorithm>

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

}  // namespace

void match_only_clauses(const AlignedText& first, const AlignedText& second, Alignment& alignment) {
    if (first.clauses.size() != 1 || second.clauses.size() != 1 || alignment.clause_of[0] != Alignment::kNone) return;
    alignment.clause_of[0] = 0;
    alignment.likeness[0] = 1.0;
    const size_t here = first.words.size(), there = second.words.size(), most = std::min(here, there);
    size_t head = 0, tail = 0;
    while (head < most && first.exact[head] == second.exact[head]) ++head;
    while (tail < most - head && first.exact[here - 1 - tail] == second.exact[there - 1 - tail]) ++tail;
    for (size_t i = 0; i < head; ++i) alignment.word_of[i] = i;
    for (size_t i = 1; i <= tail; ++i) alignment.word_of[here - i] = there - i;
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

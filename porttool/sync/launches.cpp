// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/launches.h"

#include <algorithm>

#include "porttool/normal/normal_text.h"

namespace porttool {
namespace {

bool has_chevrons(const AlignedText& text, const Clause& clause) {
    for (size_t i = clause.first; i + 2 < clause.end; ++i)
        if (text.words[i] == "<" && text.words[i + 1] == "<" && text.words[i + 2] == "<") return true;
    return false;
}

/// `k < < < g , b > > > ( a ) ;`, or a function of the run time that starts a kernel.
bool is_launching_statement(const AlignedText& text, const Clause& clause) {
    if (clause.opens || clause.closes) return false;
    return has_chevrons(text, clause) ||
           is_one_of(text.words[clause.first], {"hipLaunchKernelGGL", "cudaLaunchKernel", "hipLaunchKernel"});
}

/// True if words have a call of the method `name`.
bool calls_method(const AlignedText& text, size_t first, size_t end, std::string_view name) {
    for (size_t i = first + 1; i + 1 < end; ++i)
        if (text.words[i] == name && is_one_of(text.words[i - 1], {".", "->"}) &&
            is_one_of(text.words[i + 1], {"(", "<"}))
            return true;
    return false;
}

/// `q . submit ( [ & ] ( handler & h ) {` around a kernel, or `q . parallel_for ( n , [ = ] ( item < 1 > i ) {`.
bool opens_submission(const AlignedText& text, const Clause& clause) {
    if (!clause.opens || clause.partner == Clause::kNone) return false;
    const auto runs_kernel = [&](size_t end) {
        return calls_method(text, clause.first, end, "parallel_for") ||
               calls_method(text, clause.first, end, "single_task");
    };
    return runs_kernel(clause.end) ||
           (calls_method(text, clause.first, clause.end, "submit") && runs_kernel(text.clauses[clause.partner].first));
}

/// `# pragma omp target teams ...`: not one that only says where data is.
bool is_offloading_directive(const AlignedText& text, const Clause& clause) {
    const auto word = [&](size_t i) {
        return clause.first + i < clause.end ? std::string_view(text.words[clause.first + i]) : std::string_view();
    };
    return word(0) == "#" && word(1) == "pragma" && word(2) == "omp" && word(3) == "target" &&
           !is_one_of(word(4), {"data", "update", "enter", "exit"});
}

/// The head of the block that a directive stands before, with others in between; kNone for none.
size_t block_governed_by(const AlignedText& text, size_t directive) {
    size_t c = directive + 1;
    while (c < text.clauses.size() && text.words[text.clauses[c].first] == "#") ++c;
    const bool opens = c < text.clauses.size() && text.clauses[c].opens && text.clauses[c].partner != Clause::kNone;
    return opens ? c : Clause::kNone;
}

bool has_word_in(const AlignedText& text, const Clause& clause, std::string_view word) {
    for (size_t i = clause.first; i < clause.end; ++i)
        if (text.words[i] == word) return true;
    return false;
}

constexpr double kSameStart = 0.6;  ///< what is less alike may stand for something else

/// True where the counterparts of what stands before and behind `here` stand before and behind `there`.
bool agrees(const LaunchPair& pair, const Alignment& alignment) {
    for (size_t c = 0; c < alignment.clause_of.size(); ++c) {
        const size_t other = alignment.clause_of[c];
        if (other == Alignment::kNone || alignment.likeness[c] < kSameStart) continue;
        if (c < pair.here.first && other > pair.there.last) return false;
        if (c > pair.here.last && other < pair.there.first) return false;
    }
    return true;
}

}  // namespace

std::vector<Launch> launches_in(const AlignedText& text) {
    std::vector<Launch> out;
    const std::vector<Clause>& clauses = text.clauses;
    for (size_t c = 1; c < clauses.size(); ++c) {
        if (is_launching_statement(text, clauses[c])) {
            out.push_back({c, c, false});
        } else if (opens_submission(text, clauses[c])) {
            size_t last = clauses[c].partner;
            // What is left of the statement: `) ;`, `) . wait ( ) ;`.
            if (last + 1 < clauses.size() && text.words[clauses[last + 1].first] == ")") ++last;
            out.push_back({c, last, has_word_in(text, clauses[last], "wait")});
            c = last;
        } else if (const size_t block =
                       is_offloading_directive(text, clauses[c]) ? block_governed_by(text, c) : Clause::kNone;
                   block != Clause::kNone) {
            const size_t last = clauses[block].partner;
            out.push_back({c, last, !has_word_in(text, clauses[c], "nowait")});
            c = last;
        }
    }
    return out;
}

std::vector<LaunchPair> paired_launches(const AlignedText& first, const AlignedText& second,
                                        const Alignment& alignment) {
    const std::vector<Launch> here = launches_in(first), there = launches_in(second);
    std::vector<LaunchPair> out;
    if (here.size() != there.size()) return out;
    for (size_t i = 0; i < here.size(); ++i) {
        const LaunchPair pair{here[i], there[i]};
        const bool are_statements = pair.here.first == pair.here.last && pair.there.first == pair.there.last;
        if (!are_statements && agrees(pair, alignment)) out.push_back(pair);
    }
    return out;
}

std::vector<std::string> with_plain_extents(const std::vector<std::string>& words, size_t first, size_t end) {
    std::vector<std::string> out(words.begin() + static_cast<std::ptrdiff_t>(first),
                                 words.begin() + static_cast<std::ptrdiff_t>(end));
    for (size_t i = 0; i + 1 < out.size(); ++i) {
        if (out[i] != "dim3" || out[i + 1] != "(" || i == 0 || !is_one_of(out[i - 1], {",", "<"})) continue;
        int depth = 0;
        size_t close = i + 1;
        bool is_list = false;
        for (; close < out.size(); ++close) {
            depth += is_one_of(out[close], {"(", "["}) ? 1 : is_one_of(out[close], {")", "]"}) ? -1 : 0;
            if (depth == 0) break;
            is_list |= depth == 1 && out[close] == ",";
        }
        if (close == out.size() || is_list) continue;
        out.erase(out.begin() + static_cast<std::ptrdiff_t>(close));
        out.erase(out.begin() + static_cast<std::ptrdiff_t>(i), out.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    }
    return out;
}

}  // namespace porttool

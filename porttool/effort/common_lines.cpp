// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/common_lines.h"

#include <algorithm>

#include "metrics/code/winnowing.h"
#include "porttool/measure/measure.h"
#include "porttool/measure/symbols.h"

namespace porttool {
namespace {

/// A line's place in a sequence of symbols.
struct LineRange {
    uint32_t line = 0;
    size_t first = 0, last = 0;
};

/// One side as symbols, with its lines and which of them lie in a run.
struct SideInRuns {
    std::vector<PlacedToken> tokens;
    SymbolSequence sequence;
    std::vector<LineRange> lines;
    std::vector<bool> in_run;  ///< by index into lines

    SideInRuns(SymbolTable& table, const Excerpt& excerpt, uint32_t side) : tokens(table.place({excerpt})) {
        sequence = table.sequence(tokens, Vocabulary::Dialect, side);
        for (size_t i = 0; i < sequence.symbols.size(); ++i) {
            if (sequence.tokens[i] == kNoToken) continue;
            const uint32_t line = tokens[sequence.tokens[i]].line;
            if (lines.empty() || lines.back().line != line) lines.push_back({line, i, i});
            lines.back().last = i;
        }
        in_run.resize(lines.size());
    }

    /// The first line that ends at a symbol or after it.
    size_t line_at(size_t symbol) const {
        const auto found = std::lower_bound(lines.begin(), lines.end(), symbol,
                                            [](const LineRange& range, size_t at) { return range.last < at; });
        return static_cast<size_t>(found - lines.begin());
    }

    /// Calls use(index) for each line that lies as a whole in a run.
    template <class Use>
    void for_lines_in(size_t first, size_t length, const Use& use) const {
        size_t at = line_at(first);
        if (at < lines.size() && lines[at].first < first) ++at;
        for (; at < lines.size() && lines[at].last < first + length; ++at) use(at);
    }

    LineSet found() const {
        LineSet out;
        for (size_t i = 0; i < lines.size(); ++i)
            if (in_run[i]) out.push_back(lines[i].line);
        return out;
    }
};

/// How many of the lines before each one are new.
std::vector<size_t> count_new(const SideInRuns& side, const EditedLines& edit) {
    std::vector<size_t> out = {0};
    for (const LineRange& range : side.lines) out.push_back(out.back() + (edit.is_new(range.line) ? 1 : 0));
    return out;
}

}  // namespace

CommonLines common_lines(const Excerpt& source, const Excerpt& target, const EditedLines& target_edit,
                         const Dialect& dialect) {
    SymbolTable table(dialect);
    SideInRuns a(table, source, 0), b(table, target, 1);
    const std::vector<size_t> new_before = count_new(b, target_edit);
    for (const metrics::TokenMatch& run : metrics::winnowing_matches(a.sequence.symbols, b.sequence.symbols, {12, 1})) {
        a.for_lines_in(run.a, run.length, [&](size_t at) {
            const size_t first = b.line_at(a.lines[at].first - run.a + run.b),
                         last = b.line_at(a.lines[at].last - run.a + run.b);
            if (new_before[last + 1] > new_before[first]) a.in_run[at] = true;
        });
        b.for_lines_in(run.b, run.length, [&](size_t at) { b.in_run[at] = true; });
    }
    return {a.found(), b.found(), half_shared_lines(a.sequence, b.tokens, b.sequence)};
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/measure.h"

#include <algorithm>
#include <numeric>

#include "porttool/compare/symbols.h"

namespace porttool {
namespace {

using metrics::TokenMatch;
using metrics::WinnowingParameters;

/// Both passages as numbers in one vocabulary, and what they share.
struct Shares {
    SymbolSequence a, b;
    std::vector<TokenMatch> matches;
    std::vector<uint8_t> covered_a, covered_b;
    bool measured = false;
};

struct Sides {
    std::vector<PlacedToken> a, b;
};

Shares find_shares(const SymbolTable& table, const Sides& sides, Vocabulary vocabulary,
                   const WinnowingParameters& parameters) {
    Shares shares;
    shares.a = table.sequence(sides.a, vocabulary, 0);
    shares.b = table.sequence(sides.b, vocabulary, 1);
    shares.matches = metrics::winnowing_matches(shares.a.symbols, shares.b.symbols, parameters);
    shares.covered_a = metrics::covered_in_a(shares.matches, shares.a.symbols.size());
    shares.covered_b = metrics::covered_in_b(shares.matches, shares.b.symbols.size());
    shares.measured = std::min(shares.a.longest_run, shares.b.longest_run) >= parameters.guarantee();
    return shares;
}

double percent(const std::vector<uint8_t>& covered, uint32_t of) {
    return 100.0 * std::accumulate(covered.begin(), covered.end(), 0.0) / of;
}

/// The code lines of each excerpt. A line is shared if at least half of its tokens are covered; one whose tokens all
/// have no counterpart (`inline` alone) goes with the line after it, the last with the one before.
std::vector<std::vector<CodeLine>> lines_of(const Passage& passage, const std::vector<PlacedToken>& tokens,
                                            const SymbolSequence& sequence, const std::vector<uint8_t>& covered) {
    struct Count {
        uint32_t tokens = 0, covered = 0;
    };
    std::vector<Count> of_token(tokens.size());
    for (size_t i = 0; i < sequence.symbols.size(); ++i)
        if (sequence.tokens[i] != kNoToken) of_token[sequence.tokens[i]] = {1, covered[i]};
    std::vector<std::vector<CodeLine>> out(passage.size());
    std::vector<std::vector<Count>> counts(passage.size());
    for (size_t i = 0; i < tokens.size(); ++i) {
        std::vector<CodeLine>& lines = out[tokens[i].excerpt];
        std::vector<Count>& line_counts = counts[tokens[i].excerpt];
        if (lines.empty() || lines.back().line != tokens[i].line) {
            lines.push_back({tokens[i].line, false});
            line_counts.push_back({});
        }
        line_counts.back().tokens += of_token[i].tokens;
        line_counts.back().covered += of_token[i].covered;
    }
    for (size_t excerpt = 0; excerpt < out.size(); ++excerpt) {
        std::vector<CodeLine>& lines = out[excerpt];
        bool next = false;
        for (size_t i = lines.size(); i-- > 0;) {
            const Count& count = counts[excerpt][i];
            if (count.tokens > 0) next = 2 * count.covered >= count.tokens;
            lines[i].shared = next;
        }
        for (size_t i = lines.size(); i-- > 0 && counts[excerpt][i].tokens == 0;) lines[i].shared = false;
    }
    return out;
}

void count_lines(const std::vector<std::vector<CodeLine>>& lines, SideMeasure& side) {
    for (const std::vector<CodeLine>& excerpt : lines) {
        side.lines += static_cast<uint32_t>(excerpt.size());
        side.shared_lines += static_cast<uint32_t>(
            std::count_if(excerpt.begin(), excerpt.end(), [](const CodeLine& line) { return line.shared; }));
    }
}

ExcerptLines lines_between(const std::vector<PlacedToken>& tokens, const SymbolSequence& sequence, uint32_t first,
                           uint32_t length) {
    const PlacedToken& start = tokens[sequence.tokens[first]];
    const PlacedToken& end = tokens[sequence.tokens[first + length - 1]];
    return {start.excerpt, start.line, end.line};
}

}  // namespace

Similarity measure_shares(const Passage& a, const Passage& b, const Dialect& dialect,
                          const WinnowingParameters& parameters) {
    SymbolTable table(dialect);
    const Sides sides{table.place(a), table.place(b)};
    Similarity out;
    const Shares shares = find_shares(table, sides, Vocabulary::Dialect, parameters);
    const Shares blind = find_shares(table, sides, Vocabulary::Blind, parameters);
    const Shares raw = find_shares(table, sides, Vocabulary::Raw, parameters);
    auto put = [](const Shares& from, std::optional<double>& in_a, std::optional<double>& in_b) {
        if (!from.measured) return;
        in_a = percent(from.covered_a, from.a.token_count);
        in_b = percent(from.covered_b, from.b.token_count);
    };
    put(shares, out.a.moss_percent, out.b.moss_percent);
    put(blind, out.a.moss_percent_blind, out.b.moss_percent_blind);
    put(raw, out.a.moss_percent_raw, out.b.moss_percent_raw);
    out.a.tokens = shares.a.token_count;
    out.b.tokens = shares.b.token_count;
    out.a_lines = lines_of(a, sides.a, shares.a, shares.covered_a);
    out.b_lines = lines_of(b, sides.b, shares.b, shares.covered_b);
    count_lines(out.a_lines, out.a);
    count_lines(out.b_lines, out.b);
    for (const TokenMatch& match :
         metrics::essential_matches(shares.matches, shares.a.symbols.size(), shares.b.symbols.size()))
        out.matches.push_back({lines_between(sides.a, shares.a, match.a, match.length),
                               lines_between(sides.b, shares.b, match.b, match.length)});
    return out;
}

Similarity measure(const Passage& a, const Passage& b, const Dialect& dialect, const WinnowingParameters& parameters) {
    return measure_shares(a, b, dialect, parameters);
}

}  // namespace porttool

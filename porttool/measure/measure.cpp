// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/measure.h"

#include <algorithm>
#include <future>

#include "metrics/code/line_divergence.h"
#include "metrics/code/string_tiling.h"
#include "metrics/code/token_edit.h"
#include "porttool/measure/line_shares.h"
#include "porttool/measure/structure_tree.h"
#include "porttool/measure/symbols.h"
#include "porttool/text/parallel.h"

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

uint64_t mix_hash(uint64_t hash, uint32_t symbol) {
    hash = (hash ^ (symbol + 1ull)) * 0x9E3779B97F4A7C15ull;
    return hash ^ (hash >> 29);
}

Shares find_shares(const SymbolTable& table, const Sides& sides, Vocabulary vocabulary,
                   const WinnowingParameters& parameters) {
    Shares shares;
    shares.a = table.sequence(sides.a, vocabulary, 0);
    shares.b = table.sequence(sides.b, vocabulary, 1);
    shares.measured = std::min(shares.a.longest_run, shares.b.longest_run) >= parameters.guarantee();
    if (shares.measured) shares.matches = metrics::winnowing_matches(shares.a.symbols, shares.b.symbols, parameters);
    shares.covered_a = metrics::covered_in_a(shares.matches, shares.a.symbols.size());
    shares.covered_b = metrics::covered_in_b(shares.matches, shares.b.symbols.size());
    return shares;
}

double percent(const std::vector<uint8_t>& covered, uint32_t of) {
    return 100.0 * static_cast<double>(std::count(covered.begin(), covered.end(), 1)) / of;
}

/// Why nothing can be measured: what a side lacks.
std::string shortness(const Shares& shares, const WinnowingParameters& parameters) {
    const bool in_a = shares.a.longest_run <= shares.b.longest_run;
    const SymbolSequence& side = in_a ? shares.a : shares.b;
    const std::string name = in_a ? "a" : "b";
    if (side.token_count == 0) return "too short: " + name + " has no code";
    return "too short: " + name + " has " + std::to_string(side.longest_run) + " tokens" +
           (side.longest_run < side.token_count ? " in one piece" : "") + ", " +
           std::to_string(parameters.guarantee()) + " are needed";
}

/// The code lines of each excerpt.
std::vector<std::vector<CodeLine>> lines_of(size_t excerpts, const std::vector<PlacedToken>& tokens,
                                            const SymbolSequence& sequence, const std::vector<uint8_t>& covered) {
    std::vector<LineShare> of_token(tokens.size());
    for (size_t i = 0; i < sequence.symbols.size(); ++i)
        if (sequence.tokens[i] != kNoToken) of_token[sequence.tokens[i]] = {1, covered[i]};
    std::vector<std::vector<CodeLine>> out(excerpts);
    std::vector<std::vector<LineShare>> counts(excerpts);
    for (size_t i = 0; i < tokens.size(); ++i) {
        std::vector<CodeLine>& lines = out[tokens[i].excerpt];
        std::vector<LineShare>& line_counts = counts[tokens[i].excerpt];
        if (lines.empty() || lines.back().line != tokens[i].line) {
            lines.push_back({tokens[i].line, false});
            line_counts.push_back({});
        }
        line_counts.back().tokens += of_token[i].tokens;
        line_counts.back().covered += of_token[i].covered;
    }
    for (size_t excerpt = 0; excerpt < out.size(); ++excerpt) {
        const std::vector<bool> shared = shared_lines(counts[excerpt]);
        for (size_t i = 0; i < shared.size(); ++i) out[excerpt][i].shared = shared[i];
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

/// One number a line, the same for lines that say the same.
std::vector<uint64_t> line_texts(const std::vector<PlacedToken>& tokens, const SymbolSequence& sequence) {
    std::vector<uint64_t> out;
    const PlacedToken* before = nullptr;
    for (size_t i = 0; i < sequence.symbols.size(); ++i) {
        if (sequence.tokens[i] == kNoToken) continue;
        const PlacedToken& token = tokens[sequence.tokens[i]];
        const bool same_line = before != nullptr && before->excerpt == token.excerpt && before->line == token.line;
        if (!same_line) out.push_back(0);
        out.back() = mix_hash(out.back(), sequence.symbols[i]);
        before = &token;
    }
    return out;
}

/// The figures whose cost grows faster than the text.
class SlowFigures {
public:
    SlowFigures(const Shares& shares, Similarity& out) : shares_(shares), out_(out) {}

    void measure_tiling() {
        constexpr metrics::TilingParameters kParameters;
        if (is_too_long("tiling")) return;
        const auto tiles = metrics::greedy_tiles(shares_.a.symbols, shares_.b.symbols, kParameters);
        if (tiles)
            out_.tiling = metrics::tiling_similarity(*tiles, shares_.a.token_count, shares_.b.token_count);
        else
            out_.unmeasured["tiling"] = "too repetitive: above " + std::to_string(kParameters.most_pairs) +
                                        " pairs of equal runs of " + std::to_string(kParameters.minimum) + " tokens";
    }

    void measure_edits() {
        if (is_too_long("token_edit")) return;
        const std::vector<uint32_t> a = without_separators(shares_.a), b = without_separators(shares_.b);
        const uint64_t longer = std::max(a.size(), b.size());
        constexpr uint64_t kMostEdits = 8192;
        if (const auto distance = metrics::edit_distance_within(a, b, kMostEdits))
            out_.token_edit = 1.0 - static_cast<double>(*distance) / static_cast<double>(longer);
        else
            out_.unmeasured["token_edit"] = "too different: above " + std::to_string(kMostEdits) + " edits";
    }

    void measure_trees(const Passage& a, const Passage& b, const Dialect& dialect) {
        if (is_too_long("tree_distance")) return;
        const metrics::Tree left = structure_tree(a, dialect), right = structure_tree(b, dialect);
        constexpr uint64_t kMostSteps = 30'000'000;
        if (metrics::tree_distance_cost(left, right) > kMostSteps)
            out_.unmeasured["tree_distance"] = "too large: trees of " + std::to_string(left.size()) + " and " +
                                               std::to_string(right.size()) + " statements and blocks";
        else
            out_.tree_distance = metrics::normalized_tree_distance(left, right);
    }

private:
    bool is_too_long(const char* figure) {
        constexpr uint32_t kMostTokens = 100'000;
        const uint32_t longer = std::max(shares_.a.token_count, shares_.b.token_count);
        if (longer <= kMostTokens) return false;
        out_.unmeasured[figure] =
            "too long: " + std::to_string(longer) + " tokens, at most " + std::to_string(kMostTokens);
        return true;
    }

    static std::vector<uint32_t> without_separators(const SymbolSequence& sequence) {
        std::vector<uint32_t> out;
        for (size_t i = 0; i < sequence.symbols.size(); ++i)
            if (sequence.tokens[i] != kNoToken) out.push_back(sequence.symbols[i]);
        return out;
    }

    const Shares& shares_;
    Similarity& out_;
};

/// Everything that costs linear time; also hands out the shares in the common vocabulary.
Similarity measure_linear(const Passage& a, const Passage& b, const Dialect& dialect,
                          const WinnowingParameters& parameters, Shares& shares) {
    SymbolTable table(dialect);
    Sides sides;
    sides.a = table.place(a);
    sides.b = table.place(b);
    Similarity out;
    // The three vocabularies have nothing to do with each other; for long texts each gets a thread. For the longest one
    // after the other is done, so that their tables are not in memory together.
    constexpr size_t kWorthAThread = 100'000, kTooLargeTogether = 4'000'000;
    const size_t tokens = sides.a.size() + sides.b.size();
    const bool at_once = tokens > kWorthAThread && tokens < kTooLargeTogether;
    const std::launch when = in_a_thread_if(at_once);
    const auto find = [&](Vocabulary vocabulary) { return find_shares(table, sides, vocabulary, parameters); };
    std::future<Shares> blind = std::async(when, find, Vocabulary::Blind);
    std::future<Shares> raw = std::async(when, find, Vocabulary::Raw);
    const auto note = [&](Shares found, const char* name, std::optional<double>& in_a, std::optional<double>& in_b) {
        if (found.measured) {
            in_a = percent(found.covered_a, found.a.token_count);
            in_b = percent(found.covered_b, found.b.token_count);
        } else {
            out.unmeasured[name] = shortness(found, parameters);
        }
        return found;
    };
    shares = note(find(Vocabulary::Dialect), "moss_percent", out.a.moss_percent, out.b.moss_percent);
    note(blind.get(), "moss_percent_blind", out.a.moss_percent_blind, out.b.moss_percent_blind);
    note(raw.get(), "moss_percent_raw", out.a.moss_percent_raw, out.b.moss_percent_raw);
    out.a.tokens = shares.a.token_count;
    out.b.tokens = shares.b.token_count;
    out.a_lines = lines_of(a.size(), sides.a, shares.a, shares.covered_a);
    out.b_lines = lines_of(b.size(), sides.b, shares.b, shares.covered_b);
    count_lines(out.a_lines, out.a);
    count_lines(out.b_lines, out.b);
    for (const TokenMatch& match :
         metrics::essential_matches(shares.matches, shares.a.symbols.size(), shares.b.symbols.size()))
        out.matches.push_back({lines_between(sides.a, shares.a, match.a, match.length),
                               lines_between(sides.b, shares.b, match.b, match.length)});
    if (shares.measured)
        out.line_divergence = metrics::line_divergence(line_texts(sides.a, shares.a), line_texts(sides.b, shares.b));
    else
        out.unmeasured["line_divergence"] = shortness(shares, parameters);
    return out;
}

}  // namespace

Similarity measure_shares(const Passage& a, const Passage& b, const Dialect& dialect,
                          const WinnowingParameters& parameters) {
    Shares shares;
    return measure_linear(a, b, dialect, parameters, shares);
}

std::vector<uint32_t> half_shared_lines(const SymbolSequence& a, const std::vector<PlacedToken>& b_tokens,
                                        const SymbolSequence& b) {
    constexpr WinnowingParameters kParameters;
    std::vector<TokenMatch> matches;
    if (std::min(a.longest_run, b.longest_run) >= kParameters.guarantee())
        matches = metrics::winnowing_matches(a.symbols, b.symbols, kParameters);
    const auto lines = lines_of(1, b_tokens, b, metrics::covered_in_b(matches, b.symbols.size()));
    std::vector<uint32_t> out;
    for (const CodeLine& line : lines.front())
        if (line.shared) out.push_back(line.line);
    return out;
}

Similarity measure(const Passage& a, const Passage& b, const Dialect& dialect, const WinnowingParameters& parameters) {
    Shares shares;
    Similarity out = measure_linear(a, b, dialect, parameters, shares);
    if (!shares.measured) {
        for (const char* name : {"tiling", "token_edit", "tree_distance"})
            out.unmeasured[name] = shortness(shares, parameters);
        return out;
    }
    SlowFigures figures(shares, out);
    figures.measure_tiling();
    figures.measure_edits();
    figures.measure_trees(a, b, dialect);
    return out;
}

}  // namespace porttool

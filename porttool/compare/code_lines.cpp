// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/code_lines.h"

#include <algorithm>

namespace porttool {
namespace {

/// `#ifndef X`, `#define X` before everything else, and the `#endif` of the former behind it.
bool is_include_guard(const LexedText& lexed) {
    const std::vector<Directive>& directives = lexed.directives;
    if (directives.size() < 3) return false;
    const Directive &test = directives[0], &define = directives[1], &last = directives.back();
    const bool shape = test.first_token == 0 && test.end_token == 3 && lexed.view(1) == "ifndef" &&
                       define.kind == DirectiveKind::Define && define.first_token == 3 && define.end_token == 6 &&
                       lexed.view(2) == lexed.view(5) && last.kind == DirectiveKind::Endif &&
                       last.end_token == lexed.tokens.size();
    if (!shape) return false;
    int depth = 0;
    for (const Directive& directive : directives) {
        if (directive.kind == DirectiveKind::If) ++depth;
        if (directive.kind == DirectiveKind::Endif && --depth == 0) return &directive == &last;
    }
    return false;
}

/// The directives within a range that are boilerplate, ascending.
std::vector<TokenRange> boilerplate(const LexedText& lexed, TokenRange range) {
    const std::vector<Directive>& directives = lexed.directives;
    auto at = std::lower_bound(directives.begin(), directives.end(), range.first,
                               [](const Directive& directive, uint32_t token) { return directive.end_token <= token; });
    const bool guarded = (range.first < 6 || range.end == lexed.tokens.size()) && is_include_guard(lexed);
    std::vector<TokenRange> out;
    for (; at != directives.end() && at->first_token < range.end; ++at) {
        const bool of_guard = guarded && (at - directives.begin() < 2 || at + 1 == directives.end());
        if (of_guard || at->kind == DirectiveKind::Include || at->kind == DirectiveKind::Other)
            out.push_back({at->first_token, at->end_token});
    }
    return out;
}

/// Walks ascending ranges with ascending tokens.
class RangeCursor {
public:
    explicit RangeCursor(std::vector<TokenRange> ranges) : ranges_(std::move(ranges)) {}
    bool holds(uint32_t token) {
        while (at_ < ranges_.size() && ranges_[at_].end <= token) ++at_;
        return at_ < ranges_.size() && ranges_[at_].first <= token;
    }

private:
    std::vector<TokenRange> ranges_;
    size_t at_ = 0;
};

}  // namespace

std::vector<std::vector<uint32_t>> code_runs(const Excerpt& excerpt) {
    const LexedText& lexed = excerpt.file->lexed;
    const TokenRange range =
        excerpt.unit != nullptr ? excerpt.unit->tokens : TokenRange{0, static_cast<uint32_t>(lexed.tokens.size())};
    RangeCursor left_out(boilerplate(lexed, range));
    RangeCursor holes(excerpt.unit != nullptr ? excerpt.unit->holes : std::vector<TokenRange>());
    std::vector<std::vector<uint32_t>> runs(1);
    for (uint32_t i = range.first; i < range.end; ++i) {
        if (holes.holds(i)) {
            if (!runs.back().empty()) runs.emplace_back();
        } else if ((lexed.tokens[i].flags & kDead) == 0 && !left_out.holds(i)) {
            runs.back().push_back(i);
        }
    }
    if (runs.back().empty()) runs.pop_back();
    return runs;
}

std::vector<uint32_t> code_lines(const Excerpt& excerpt) {
    std::vector<uint32_t> lines;
    for (const std::vector<uint32_t>& run : code_runs(excerpt))
        for (const uint32_t token : run) {
            const uint32_t line = excerpt.file->lexed.tokens[token].line;
            if (lines.empty() || lines.back() != line) lines.push_back(line);
        }
    return lines;
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/code_lines.h"

#include <algorithm>

namespace porttool {
namespace {

/// The pair of directives that opens an include guard (`#ifndef X`, `#define X`), and the `#endif` that closes it.
struct Guard {
    bool there = false;
    size_t endif = 0;  ///< an index into LexedText::directives
};

bool is_first_token(const LexedText& lexed, uint32_t token) { return lexed.directives.front().first_token == token; }

Guard find_guard(const LexedText& lexed) {
    const std::vector<Directive>& directives = lexed.directives;
    if (directives.size() < 3 || lexed.tokens.empty() || !is_first_token(lexed, 0)) return {};
    const Directive &test = directives[0], &define = directives[1], &last = directives.back();
    const bool shape = test.end_token - test.first_token == 3 && lexed.view(test.first_token + 1) == "ifndef" &&
                       define.kind == DirectiveKind::Define && define.first_token == test.end_token &&
                       define.end_token - define.first_token == 3 &&
                       lexed.view(test.first_token + 2) == lexed.view(define.first_token + 2) &&
                       last.kind == DirectiveKind::Endif && last.end_token == lexed.tokens.size();
    if (!shape) return {};
    int depth = 0;
    for (size_t i = 0; i < directives.size(); ++i) {
        if (directives[i].kind == DirectiveKind::If) ++depth;
        if (directives[i].kind == DirectiveKind::Endif && --depth == 0) return {i + 1 == directives.size(), i};
    }
    return {};
}

/// 1 for each token that is boilerplate.
std::vector<uint8_t> boilerplate(const LexedText& lexed) {
    std::vector<uint8_t> out(lexed.tokens.size());
    const Guard guard = find_guard(lexed);
    for (size_t i = 0; i < lexed.directives.size(); ++i) {
        const Directive& directive = lexed.directives[i];
        const bool of_guard = guard.there && (i < 2 || i == guard.endif);
        if (of_guard || directive.kind == DirectiveKind::Include || directive.kind == DirectiveKind::Other)
            std::fill(out.begin() + directive.first_token, out.begin() + directive.end_token, uint8_t{1});
    }
    return out;
}

}  // namespace

std::vector<std::vector<uint32_t>> code_runs(const Excerpt& excerpt) {
    const LexedText& lexed = excerpt.file->lexed;
    const std::vector<uint8_t> left_out = boilerplate(lexed);
    const TokenRange range =
        excerpt.unit != nullptr ? excerpt.unit->tokens : TokenRange{0, static_cast<uint32_t>(lexed.tokens.size())};
    const std::vector<TokenRange> holes = excerpt.unit != nullptr ? excerpt.unit->holes : std::vector<TokenRange>();
    std::vector<std::vector<uint32_t>> runs(1);
    auto hole = holes.begin();
    for (uint32_t i = range.first; i < range.end; ++i) {
        while (hole != holes.end() && hole->end <= i) ++hole;
        if (hole != holes.end() && hole->first <= i) {
            if (!runs.back().empty()) runs.emplace_back();
            i = hole->end - 1;
        } else if (left_out[i] == 0 && (lexed.tokens[i].flags & kDead) == 0) {
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

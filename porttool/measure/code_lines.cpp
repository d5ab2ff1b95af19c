// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/code_lines.h"

#include <algorithm>

namespace porttool {
namespace {

/// `#ifndef X`, `#define X` before everything else, and the `#endif` of the former after it.
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

/// The directives of a range of tokens that are boilerplate, and the holes of its unit: what is left out as a whole.
std::vector<TokenRange> left_out(const Excerpt& excerpt, TokenRange range) {
    const LexedText& lexed = excerpt.file->lexed;
    const std::vector<Directive>& directives = lexed.directives;
    const bool guarded = (range.first < 6 || range.end == lexed.tokens.size()) && is_include_guard(lexed);
    std::vector<TokenRange> out;
    if (excerpt.unit != nullptr) out = excerpt.unit->holes;
    const auto first = std::partition_point(directives.begin(), directives.end(),
                                            [&](const Directive& one) { return one.end_token <= range.first; });
    for (auto at = first; at != directives.end() && at->first_token < range.end; ++at) {
        const bool of_guard = guarded && (at - directives.begin() < 2 || at + 1 == directives.end());
        if (of_guard || at->kind == DirectiveKind::Include || at->kind == DirectiveKind::Other)
            out.push_back({at->first_token, at->end_token});
    }
    std::sort(out.begin(), out.end(), [](TokenRange a, TokenRange b) { return a.first < b.first; });
    return out;
}

}  // namespace

std::vector<TokenRange> code_stretches(const Excerpt& excerpt) {
    const std::vector<Token>& tokens = excerpt.file->lexed.tokens;
    const TokenRange range =
        excerpt.unit != nullptr ? excerpt.unit->tokens : TokenRange{0, static_cast<uint32_t>(tokens.size())};
    std::vector<TokenRange> stretches;
    uint32_t at = range.first;
    const auto take_until = [&](uint32_t end) {
        while (at < end) {
            while (at < end && (tokens[at].flags & kDead) != 0) ++at;
            const uint32_t first = at;
            while (at < end && (tokens[at].flags & kDead) == 0) ++at;
            if (first < at) stretches.push_back({first, at});
        }
    };
    for (const TokenRange& gap : left_out(excerpt, range)) {
        take_until(std::min(gap.first, range.end));
        at = std::max(at, gap.end);
    }
    take_until(range.end);
    return stretches;
}

std::vector<uint32_t> code_lines(const Excerpt& excerpt) {
    std::vector<uint32_t> lines;
    uint32_t last = 0;
    for (const TokenRange& stretch : code_stretches(excerpt))
        for (uint32_t token = stretch.first; token < stretch.end; ++token) {
            const uint32_t line = excerpt.file->lexed.tokens[token].line;
            if (line != last) lines.push_back(last = line);
        }
    return lines;
}

}  // namespace porttool

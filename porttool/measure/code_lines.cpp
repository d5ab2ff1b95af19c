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

/// Walks ascending tokens and tells which belong to directives that are boilerplate.
class Boilerplate {
public:
    Boilerplate(const LexedText& lexed, TokenRange range)
        : directives_(lexed.directives),
          guarded_((range.first < 6 || range.end == lexed.tokens.size()) && is_include_guard(lexed)) {
        skip_to(range.first);
    }

    void skip_to(uint32_t token) {
        at_ = std::lower_bound(directives_.begin() + at_, directives_.end(), token,
                               [](const Directive& directive, uint32_t i) { return directive.end_token <= i; }) -
              directives_.begin();
    }

    bool holds(uint32_t token) {
        const auto count = static_cast<std::ptrdiff_t>(directives_.size());
        while (at_ < count && directives_[static_cast<size_t>(at_)].end_token <= token) ++at_;
        if (at_ == count) return false;
        const Directive& directive = directives_[static_cast<size_t>(at_)];
        if (directive.first_token > token) return false;
        const bool of_guard = guarded_ && (at_ < 2 || at_ + 1 == count);
        return of_guard || directive.kind == DirectiveKind::Include || directive.kind == DirectiveKind::Other;
    }

private:
    const std::vector<Directive>& directives_;
    bool guarded_;
    std::ptrdiff_t at_ = 0;
};

}  // namespace

std::vector<std::vector<uint32_t>> code_runs(const Excerpt& excerpt) {
    const LexedText& lexed = excerpt.file->lexed;
    const TokenRange range =
        excerpt.unit != nullptr ? excerpt.unit->tokens : TokenRange{0, static_cast<uint32_t>(lexed.tokens.size())};
    Boilerplate left_out(lexed, range);
    static const std::vector<TokenRange> kNone;
    const std::vector<TokenRange>& holes = excerpt.unit != nullptr ? excerpt.unit->holes : kNone;
    size_t hole = 0;
    std::vector<std::vector<uint32_t>> runs(1);
    for (uint32_t i = range.first; i < range.end; ++i) {
        while (hole < holes.size() && holes[hole].end <= i) ++hole;
        if (hole < holes.size() && holes[hole].first <= i) {
            if (!runs.back().empty()) runs.emplace_back();
            i = holes[hole].end - 1;
            left_out.skip_to(i + 1);
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

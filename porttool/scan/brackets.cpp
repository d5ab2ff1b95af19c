// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/brackets.h"

#include <string_view>

#include "porttool/language/words.h"

namespace porttool {
namespace {

class BracketMatcher {
public:
    BracketMatcher(const LexedText& lexed, Structure& out, bool by_indent)
        : lexed_(lexed), out_(out), by_indent_(by_indent) {}

    /// False if a brace stays without partner, or seems to have found the wrong one.
    bool run() {
        out_.match.assign(out_.tokens.size(), kNoMatch);
        for (uint32_t i = 0; i < out_.tokens.size(); ++i) {
            const Token& token = lexed_.tokens[out_.tokens[i]];
            if (token.line != line_) indent() = lexed_.column(token);
            line_ = token.line;
            if (token.kind != TokenKind::Punctuator || token.length != 1) continue;
            read(i, lexed_.text[token.offset]);
        }
        return lone_closing_ == 0 && open_braces_ == 0 && !lost_brace_;
    }

private:
    struct Open {
        uint32_t index;
        uint32_t indent;  ///< column of the first token on the line that opens, or on which its parameters began
        char bracket;
        uint32_t inner;  ///< the same of the last line that began in it, and in no bracket within it
    };

    /// Of the last line that began as deep as what is read now: not in a list that has ended since.
    uint32_t& indent() { return open_.empty() ? indent_ : open_.back().inner; }

    void read(uint32_t i, char c) {
        if (c == '(' || c == '[' || c == '{') {
            open_.push_back({i, indent(), c, indent()});
            if (c == '{') ++open_braces_;
        } else if (c == ')' || c == ']') {
            const char opening = c == ')' ? '(' : '[';
            if (!open_.empty() && open_.back().bracket == opening) pair(i);
        } else if (c == '}') {
            close_brace(i);
        }
    }

    void close_brace(uint32_t i) {
        if (open_braces_ == 0) {
            ++lone_closing_;
            return;
        }
        while (open_.back().bracket != '{') open_.pop_back();
        const Token& token = lexed_.tokens[out_.tokens[i]];
        if (by_indent_ && (token.flags & kStartsLine) != 0) {
            const uint32_t column = lexed_.column(token);
            if (column > open_.back().indent) return;  // one too many, inside a block that goes on
            unwind_to_indent(column);
        }
        lost_brace_ = lost_brace_ || seems_lost(i, token);
        pair(i);
    }

    /// A brace in the first column that closes an indented block, with a declaration after it in the first column: the
    /// block lost its own brace, even if another one too many makes the sum right.
    bool seems_lost(uint32_t i, const Token& brace) const {
        if (lexed_.column(brace) != 1 || (brace.flags & kStartsLine) == 0 || open_.back().indent == 1) return false;
        if (i + 1 >= out_.tokens.size() || open_braces_ < 2 || open_.front().indent != 1) return false;
        const Token& next = lexed_.tokens[out_.tokens[i + 1]];
        if (lexed_.column(next) != 1 || next.kind != TokenKind::Identifier) return false;
        return !word_is(lexed_.view(next), kGoesOn);
    }

    /// If an open block is indented like this brace, drops those above it, which should have closed before.
    void unwind_to_indent(uint32_t column) {
        constexpr size_t kDeepest = 64;  // brackets looked at, to stay linear
        const size_t lowest = open_.size() > kDeepest ? open_.size() - kDeepest : 0;
        for (size_t i = open_.size(); i-- > lowest;) {
            if (open_[i].bracket != '{' || open_[i].indent != column) continue;
            for (size_t k = i + 1; k < open_.size(); ++k) open_braces_ -= open_[k].bracket == '{' ? 1 : 0;
            open_.resize(i + 1);
            return;
        }
    }

    void pair(uint32_t i) {
        const uint32_t opening = open_.back().index;
        out_.match[opening] = i;
        out_.match[i] = opening;
        if (open_.back().bracket == '{') --open_braces_;
        open_.pop_back();
    }

    const LexedText& lexed_;
    Structure& out_;
    bool by_indent_;
    std::vector<Open> open_;
    int64_t open_braces_ = 0;
    int64_t lone_closing_ = 0;
    bool lost_brace_ = false;
    uint32_t line_ = 0;
    uint32_t indent_ = 0;
};

}  // namespace

Structure match_brackets(const LexedText& lexed) {
    Structure out;
    out.tokens.reserve(lexed.tokens.size());
    for (uint32_t i = 0; i < lexed.tokens.size(); ++i)
        if ((lexed.tokens[i].flags & (kInDirective | kDead | kOffStructure)) == 0) out.tokens.push_back(i);
    out.balanced = BracketMatcher(lexed, out, false).run();
    if (!out.balanced) BracketMatcher(lexed, out, true).run();
    return out;
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace porttool {

enum class TokenKind : uint8_t { Identifier, Number, String, Character, Punctuator };

/// What the scanner knows of a token beyond its kind; bits of Token::flags.
enum TokenFlag : uint8_t {
    kInDirective = 1,   ///< part of a preprocessor line
    kDead = 2,          ///< inside `#if 0`: reads as a comment
    kOffStructure = 4,  ///< in a branch that the brace matching leaves out
    kStartsLine = 8,    ///< first token of its line
};

/// One token with its place. Offsets point into LexedText::text; lines are those of the file, from 1. Kept small, as a
/// generated file can have sixty million; LexedText::column tells the rest.
struct Token {
    uint32_t offset = 0;
    uint32_t length = 0;
    uint32_t line = 0;
    TokenKind kind = TokenKind::Punctuator;
    uint8_t flags = 0;
};

enum class DirectiveKind : uint8_t { If, Elif, Else, Endif, Define, Include, Other };

/// A preprocessor line: its tokens [first_token, end_token) and the lines that it covers.
struct Directive {
    DirectiveKind kind = DirectiveKind::Other;
    uint32_t first_token = 0;
    uint32_t end_token = 0;
    uint32_t line = 0;
    uint32_t end_line = 0;
};

struct LineSpan {
    uint32_t first = 0;
    uint32_t last = 0;
};

/// A comment `porttool: ignore(RULE) reason`.
struct Suppression {
    std::string rule, reason;
    uint32_t line = 0;
    /// The ids of the units that it belongs to, once the file is scanned; comments of one line share them.
    std::shared_ptr<const std::vector<std::string>> units = nullptr;
};

/// A file as tokens. `text` is the file without byte order mark, carriage returns and line splices.
struct LexedText {
    std::string text;
    std::vector<Token> tokens;
    std::vector<Directive> directives;
    std::vector<LineSpan> comments;
    std::vector<Suppression> suppressions;
    std::vector<uint32_t> line_starts;  ///< where each line starts in `text`
    uint32_t line_count = 0;

    /// From 1, in bytes.
    uint32_t column(const Token& token) const { return token.offset - line_starts[token.line - 1] + 1; }
    std::string_view view(const Token& token) const {
        return std::string_view(text).substr(token.offset, token.length);
    }
    std::string_view view(uint32_t index) const { return view(tokens[index]); }
};

}  // namespace porttool

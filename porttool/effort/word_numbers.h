// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/scan/token.h"
#include "porttool/text/text_numbers.h"

namespace porttool {

/// Words as numbers, in the order in which they come.
using NumberedWords = std::vector<uint32_t>;

/// A number for each sequence of words, the same for the same sequence; 0 for the empty one.
class SequenceNumbers {
public:
    uint32_t number(std::span<const uint32_t> words);

private:
    TextNumbers numbers_;  ///< of the words' bytes
};

/// The words of a change as numbers: a word costs four bytes wherever it stands, and words and lines are compared by
/// number.
class WordNumbers {
public:
    explicit WordNumbers(const Dialect& dialect) : dialect_(dialect) {}

    /// The number of a token as it is written, numbers in one spelling.
    uint32_t word(std::string_view text, TokenKind kind);

    /// Appends what a text says in the common vocabulary, as split_statements() has it: without semicolons and opening
    /// braces, scopes and what has no counterpart elsewhere.
    void append_common(std::span<const uint32_t> text, NumberedWords& out) const;

    /// The common word `}`: where a block ends says little about what a text says.
    uint32_t closing_brace();

private:
    enum class Mark : uint8_t { None, OpenParen, CloseParen, Semicolon, OpenBrace, CloseBrace, Scope };
    static constexpr uint32_t kNone = 0xFFFFFFFFu;
    struct Word {
        uint32_t common = kNone;  ///< kNone: no counterpart
        Mark mark = Mark::None;
        bool is_name = false;
        bool is_read = false;  ///< else it is known as the common word of others alone
    };

    static Mark mark_of(std::string_view text);
    uint32_t number(std::string_view text);

    const Dialect& dialect_;
    TextNumbers texts_;              ///< tokens as written and common words
    std::vector<uint32_t> numbers_;  ///< of each of texts_; numbers that are spelled in two ways share one
    std::vector<Word> words_;
};

}  // namespace porttool

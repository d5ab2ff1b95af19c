// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/measure/code_lines.h"
#include "porttool/text/key_numbers.h"
#include "porttool/text/text_numbers.h"

namespace porttool {

/// How much of the text counts. Dialect: in the common vocabulary, scopes and words without counterpart dropped,
/// numbers by value, names kept. Blind: the same with every name that is no built-in of a dialect and no keyword folded
/// into one. Raw: tokens as they are written.
enum class Vocabulary : uint8_t { Dialect, Blind, Raw };

/// A token of a passage with its place.
struct PlacedToken {
    uint32_t excerpt = 0;
    uint32_t line = 0;
    uint32_t word = 0;
    bool starts_run = false;  ///< the first of an excerpt: nothing matches across
};

inline constexpr uint32_t kNoToken = 0xFFFFFFFFu;

/// A passage as numbers. `tokens[i]` is the index of the token behind `symbols[i]`; kNoToken for a separator.
struct SymbolSequence {
    std::vector<uint32_t> symbols;
    std::vector<uint32_t> tokens;
    uint32_t token_count = 0;  ///< without separators
    uint32_t longest_run = 0;
};

/// Numbers the words of two passages alike. A number is made of the word and not of the order in which words come, so
/// that figures do not depend on which side is read first. The texts must outlive it.
class SymbolTable {
public:
    explicit SymbolTable(const Dialect& dialect) : dialect_(dialect) {}

    std::vector<PlacedToken> place(const Passage& passage);

    /// The sequence in one vocabulary. Between excerpts stands a separator that occurs nowhere else; `side` (0 or 1)
    /// keeps those of the two passages apart.
    SymbolSequence sequence(const std::vector<PlacedToken>& tokens, Vocabulary vocabulary, uint32_t side) const;

    /// True if the number of a word among the tokens is not made of the word alone, since another one had it before.
    bool has_moved_word(const std::vector<PlacedToken>& tokens) const;

private:
    struct Word {
        uint32_t raw = 0;
        uint32_t dialect = 0;  ///< kNothing: dropped
        uint32_t blind = 0;
        bool name = false;
        bool scope = false;  ///< `::`
        bool moved = false;  ///< a number of it was taken
    };
    static constexpr uint32_t kNothing = 0xFFFFFFFFu;

    uint32_t number(std::string_view text, bool& moved);
    uint32_t word(std::string_view text, TokenKind kind);

    const Dialect& dialect_;
    TextNumbers known_;  ///< words as written
    std::vector<Word> words_;
    TextNumbers texts_;  ///< words as written and common ones
    std::vector<uint32_t> numbers_;
    std::vector<bool> moved_;  ///< of the same texts: their number was taken
    KeyNumbers taken_;         ///< the numbers in use
};

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"
#include "porttool/text/text_numbers.h"

namespace porttool {

/// Numbers locals and parameters in the order of their declarations, scope by scope, so that a name that is declared
/// again within a block is another variable there. Words that no declaration in force covers stay as they are. Takes
/// tokens in normal form one after the other, in linear time whatever the nesting.
///
///     float @ ( float x ) { if ( x > 0 ) { float y = x ; x = y ; } return y . x ; }
///                     1          1               2   1   1   2            (a global y; a member x)
class LocalNumbers {
public:
    /// `places`: what declaring_tokens() gave.
    explicit LocalNumbers(std::vector<uint32_t> places) : places_(std::move(places)) {}

    /// Which local the next token names, from 1; 0 for anything else.
    size_t next(std::string_view text, uint32_t token);

private:
    struct Bracket {
        bool scoped = false;
        bool block = false;
    };
    /// What a name stood for before a declaration; 0 for itself.
    struct Shadowed {
        uint32_t name;  ///< in names_
        size_t number;
    };

    size_t number_of(std::string_view text, uint32_t token);
    void enter();
    void leave();
    void open(bool scoped);
    void open_block();
    void close(bool block_follows);

    std::vector<uint32_t> places_;
    TextNumbers names_;
    std::vector<size_t> numbers_;  ///< what each of names_ stands for now; 0 for itself
    std::vector<Shadowed> shadowed_;
    std::vector<size_t> scopes_;  ///< sizes of shadowed_ where each began
    std::vector<Bracket> brackets_;
    size_t count_ = 0;
    bool pending_ = false;
    bool head_closes_ = false;  ///< the token before was `)`
    bool member_ = false;       ///< ... `.`, `->` or `::`
    bool scoped_ = false;       ///< ... a word whose parentheses are a scope
};

/// For each token of a function's text in normal form (its own name is `@`), which local it names, from 1; 0 for
/// anything else. Empty if the text is no function, or has preprocessor lines, in which declarations may stand twice.
std::vector<size_t> local_numbers(const Words& words);

}  // namespace porttool

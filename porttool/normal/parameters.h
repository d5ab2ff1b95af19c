// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "porttool/normal/bracketed_tokens.h"
#include "porttool/text/text_numbers.h"

namespace porttool {

/// What a function declares, as far as it was read.
struct Declared {
    std::vector<uint32_t> places;  ///< the tokens of its file that declare
    TextNumbers names, types;

    void add(const BracketedTokens& tokens, size_t i) {
        places.push_back(tokens.place(i));
        names.number(tokens.word(i));
    }
};

/// Adds the parameters that stand from `first` to `end`, between the parentheses of a function or a lambda. The last
/// word before a comma, a default or an array bound names a parameter if its type stands before it.
///
///     const float *a, int b[4], float (*f)(int), A::B c = d(), int      declares a, b, f and c
void read_parameters(const BracketedTokens& tokens, size_t first, size_t end, Declared& out);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// A parameter as it is declared: its type, and its name with what belongs to that. Of `double f(x, y) double x, *y;`
/// `double` and `*y`; of one that nobody declares the type is empty, and means `int`.
struct OldStyleParameter {
    TokenRange type, name;
};

/// True for a function as C once had them, with its parameters declared behind the list of their names.
bool is_old_style(const LexedText& lexed, const Unit& function);

/// True for a function that has two heads, one of each style, of which the preprocessor takes one.
bool has_two_heads(const LexedText& lexed, const Unit& function);

/// The list of the newer of two heads; empty where it has none.
TokenRange newer_list(const LexedText& lexed, const Unit& function);

/// The parameters of a function of the old style, in the order of the list.
std::vector<OldStyleParameter> old_style_parameters(const LexedText& lexed, const Unit& function);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/language/dialect.h"

namespace porttool {

/// A statement in the common vocabulary without what sides say differently and mean alike: how a variable is declared,
/// dereferenced or passed, casts, template arguments, the case of names of three letters and more, marks of numbers.
///
///     const float b1 = Dot < 3 > ( d , s1 ) * inv        b1 = dot ( d , s1 ) * inv
///     * b1 = DOT ( d , s1 ) * inv                        the same
std::vector<std::string> essence_of(const std::vector<std::string>& words, const Dialect& dialect);

/// One word of it.
std::string plain_word(const std::string& word, const Dialect& dialect);

}  // namespace porttool

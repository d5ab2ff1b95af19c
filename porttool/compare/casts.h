// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// Types of several words as one: `unsigned int` is `uint`, `long long int` is `int64_t`.
Words with_one_word_types(const Words& tokens);

/// Casts to arithmetic types as calls: `(float)n` and `static_cast<float>(n)` are `float(n)`. The words are translated
/// already.
std::vector<std::string> with_functional_casts(const std::vector<std::string>& words, const Dialect& dialect);

/// `static_cast` as a C cast, and `reinterpret_cast` to pointers to numbers: `static_cast<T*>(p)` and `(T*)(p)` are
/// `(T*)p`. To a number it is `staticcast<float>(n)`, for with_functional_casts() to go on with.
std::vector<std::string> with_c_casts(const std::vector<std::string>& words, const Dialect& dialect);

}  // namespace porttool

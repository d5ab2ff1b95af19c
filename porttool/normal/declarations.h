// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// The tokens between the parentheses and braces of a function that declare a parameter or a local, sorted. Told by
/// their shape: a type, then a name, then what may follow a declared name, where a declaration can stand; in doubt, not
/// a declaration. Takes linear time.
///
///     float shade(Ray ray, float) {              ray; the second parameter has no name
///         float a = 1.0f, *b = nullptr;          a and b
///         Hit hit(ray);                          hit, as it is a value later on: else a macro before a call
///         for (int i = 0; i < 4; ++i) a * b;     i; `a * b;` is taken for a product
///         return hit.t;
///     }
std::vector<uint32_t> declaring_tokens(const LexedText& lexed, TokenRange parameters, TokenRange body);

}  // namespace porttool

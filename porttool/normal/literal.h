// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// True if the brace words[at] opens C's literal of a struct or vector, and no block: it stands after `( float4 )`, and
/// that where a value stands in the statement that begins at `first`.
inline bool opens_literal(const Words& words, size_t first, size_t at) {
    if (at < first + 4 || words[at] != "{" || words[at - 1] != ")" || words[at - 3] != "(") return false;
    const std::string_view before = words[at - 4];
    const bool is_value = before == "return" || before == "," || before == "(" || before == "?" || before == ":" ||
                          before == "+" || before == "-" || before == "*" || before == "/" || before.ends_with('=');
    return is_value && is_word_token(words[at - 2]);
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// After the parenthesis that closes the one at `open`; the end if none does.
inline size_t after_parentheses(const Words& words, size_t open) {
    int depth = 0;
    for (size_t i = open; i < words.size(); ++i) {
        if (words[i] == "(") ++depth;
        if (words[i] == ")" && --depth == 0) return i + 1;
    }
    return words.size();
}

}  // namespace porttool

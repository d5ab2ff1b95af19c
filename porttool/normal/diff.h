// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// A step of the shortest way from one list to another.
struct DiffStep {
    enum Kind { Keep, Remove, Add } kind;
    size_t before;
    size_t now;
};

/// The longest common subsequence of two lists of texts as steps. Very long lists are compared only between their equal
/// ends, as one replacement.
///
///     before        now          steps
///     a = 1 ;       a = 1 ;      Keep
///     b = a ;       c = a ;      Remove b = a ;  Add c = a ;
///     return b ;    return b ;   Keep
std::vector<DiffStep> diff(const Words& before, const Words& now);
inline std::vector<DiffStep> diff(const std::vector<std::string>& before, const std::vector<std::string>& now) {
    return diff(Words(before.begin(), before.end()), Words(now.begin(), now.end()));
}

/// The same of texts that are known by numbers.
std::vector<DiffStep> diff(const std::vector<uint32_t>& before, const std::vector<uint32_t>& now);

/// How many words came and went, of whatever kind.
size_t words_edited(const Words& before, const Words& now);

}  // namespace porttool

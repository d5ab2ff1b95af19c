// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "porttool/scan/token.h"

namespace porttool {

inline constexpr uint32_t kNoMatch = 0xFFFFFFFFu;

/// The tokens that carry the structure of a file (no directives, no left-out branches) and the partner of each bracket.
/// Both are indexed by position in `tokens`, whose elements are indices into LexedText::tokens.
struct Structure {
    std::vector<uint32_t> tokens;
    std::vector<uint32_t> match;
    bool balanced = true;  ///< false: braces were paired with the help of the indentation
};

/// Pairs (), [] and {} in linear time. Where braces do not add up, a closing brace that starts its line closes the
/// block whose opening line is indented alike, so that one lost brace costs one function and not the rest of the file.
Structure match_brackets(const LexedText& lexed);

}  // namespace porttool

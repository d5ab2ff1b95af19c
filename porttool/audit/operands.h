// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Operands, arguments and other parts of a statement's words.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace porttool {

struct TwoOperands {
    std::vector<std::string> left, right;
};

/// What stands to both sides of the operator words[at], where both are a name, an element, a member, a call or a number
/// and belong to it alone: of `a * b - b` nothing is given for the `-`.
std::optional<TwoOperands> operands_at(const std::vector<std::string>& words, size_t at);

/// Both values of the choice whose `?` is words[at]; nothing where their ends cannot be told.
std::optional<TwoOperands> branches_at(const std::vector<std::string>& words, size_t at);

/// What stands between the bracket words[open] and its partner, cut at one word: `a` and `b` of `( a , b )`. Nothing
/// where a part is empty or the bracket is not closed.
std::vector<std::vector<std::string>> parts_of(const std::vector<std::string>& words, size_t open,
                                               const std::string& cut);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Operands, arguments and other parts of a statement's words.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace porttool {

/// Words of a statement, which must outlive what is cut out of them.
using StatementWords = std::span<const std::string>;

/// The partners of all brackets of a statement, found in one walk: whoever steps over what stands in brackets takes no
/// longer for a deep nest of them than for a flat text.
class BracketPartners {
public:
    /// Of round, square and, where `with_braces`, curly brackets; any of them may close any other.
    explicit BracketPartners(StatementWords words, bool with_braces = true);

    /// The partner of the bracket words[at]; `at` itself where there is none, or no bracket.
    size_t of(size_t at) const { return partners_[at]; }

private:
    std::vector<size_t> partners_;
};

struct TwoOperands {
    StatementWords left, right;
};

/// What stands to both sides of the operator words[at], where both are a name, an element, a member, a call or a number
/// and belong to it alone: of `a * b - b` nothing is given for the `-`.
std::optional<TwoOperands> operands_at(StatementWords words, const BracketPartners& partners, size_t at);

/// Both values of the choice whose `?` is words[at]; nothing where their ends cannot be told.
std::optional<TwoOperands> branches_at(StatementWords words, size_t at);

/// What stands between the bracket words[open] and its partner, cut at one word: `a` and `b` of `( a , b )`. Nothing
/// where a part is empty or the bracket is not closed. What stands in brackets within is stepped over.
std::vector<StatementWords> parts_of(StatementWords words, const BracketPartners& partners, size_t open,
                                     const std::string& cut);

/// True for the same words.
bool are_same(StatementWords a, StatementWords b);

/// An order of texts in which those of another size are told apart at once.
struct ShorterFirst {
    bool operator()(StatementWords a, StatementWords b) const;
};

}  // namespace porttool

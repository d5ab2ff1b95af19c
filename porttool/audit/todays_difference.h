// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What two texts say otherwise today, whoever is right, and whenever it came.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "porttool/audit/missing_edit.h"
#include "porttool/audit/said_otherwise.h"

namespace porttool {

/// What one of two statements has more than the other: `* k` of `a = b * k`.
struct OperandMore {
    bool first_has_it = false;
    std::vector<std::string> words;
};

/// Of two statements, in the vocabulary of both sides, of which one has an operand more, be it a bound around the rest
/// (`min ( x , 1 )`); nothing for others.
std::optional<OperandMore> operand_more(const std::vector<std::string>& a, const std::vector<std::string>& b);

class TodaysDifferences {
public:
    /// What it is given has to stay.
    TodaysDifferences(const CommonTexts& texts, const SaidOtherwise& otherwise);

    /// The statements that are not the same, where they are few and the rest is.
    std::vector<MissingPlace> few() const;

    /// Differences that a slip of the hand makes, whatever the rest of the texts is like: in one word, an operand more
    /// on one side, a guard or a member that is set on one side alone. `strength` says how sure it is that one side is
    /// wrong. A statement that one side lacks is "" there.
    std::vector<MissingPlace> slips() const;

private:
    using Text = std::vector<std::string>;
    /// By object and field the statements that set it.
    using Members = std::map<std::string, std::map<std::string, std::vector<size_t>>>;
    struct Slip {
        MissingPlace place;
        Text core;  ///< the words that differ
    };

    bool is_one_statement(size_t source, size_t target, float distance) const;
    bool is_no_difference(size_t source, size_t target) const;
    void add_slip(size_t source, std::vector<Slip>& out) const;
    float worth_of_slip(size_t source, size_t target) const;
    bool is_said_near(Side side, size_t index, const Text& more) const;
    float around(size_t source, size_t target) const;

    /// A call that both sides make with the same arguments but for an operand that one has more.
    void add_calls(std::vector<Slip>& out) const;
    /// A condition that asks for one thing more on one side.
    void add_conditions(std::vector<Slip>& out) const;
    void add_condition(size_t source, size_t target, std::vector<Slip>& out) const;
    bool may_slip(size_t source, size_t target) const;

    void add_guards(Side side, std::vector<MissingPlace>& out) const;
    void add_members(Side side, std::vector<MissingPlace>& out) const;
    bool stands_beside_twin(const Members& here, const Members& there, Side side, size_t index) const;
    bool is_set_by_call_of(Side side, const Text& now, const Text& then) const;
    void add_member_values(std::vector<MissingPlace>& out) const;
    Members members_of(Side side) const;
    MissingPlace place_of(Side side, size_t index) const;
    bool knows(Side side, const Text& words) const;
    bool uses_all(Side side, const std::vector<std::string>& names) const;

    const CommonTexts& texts_;
    const SaidOtherwise& otherwise_;
    BySide<std::set<Text>> said_;
    BySide<WordsOfSide> code_words_;    ///< of statements that are no preprocessor lines
    BySide<WordsOfSide> switch_words_;  ///< of those that are
};

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "porttool/audit/functions_of_side.h"
#include "porttool/audit/likeness.h"
#include "porttool/audit/lineage.h"
#include "porttool/audit/substance.h"
#include "porttool/compare/meaning.h"
#include "porttool/language/dialect.h"
#include "porttool/language/language.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/side.h"

namespace porttool {

/// A side of a pair: its unit as it is today, with what is known of its past.
struct SideOfPair {
    const UnitState* unit = nullptr;
    const UnitLineage* lineage = nullptr;
    const std::set<std::string>* elsewhere = nullptr;  ///< the statements of its file, as statement_key() has them
    const std::vector<std::vector<std::string>>* file_statements = nullptr;  ///< the same as essence_of() has them
    const WordsOfSide* file_words = nullptr;                                 ///< those that its file uses
    const UsesOnSide* uses = nullptr;                                        ///< of words on the whole side
    const FunctionsOfSide* functions = nullptr;                              ///< that a unit may call
};

/// Today's statements of one side; the first is the unit's head.
struct ReadSide {
    std::vector<WrittenStatement> written;
    std::vector<std::vector<std::string>> words;  ///< in the vocabulary of both sides
    std::vector<WeighedWords> weighed;
    std::set<size_t> repeats;  ///< statements that say for another component what the one before them says
};

/// Both texts of a pair, and what they were, in one vocabulary: names that the sides give to one thing are one, and
/// what locals hold can be written out.
///
///     source    float b1 = dot(d, s1) * inv;   u = b1;
///     target    u = Dot(dir, s1) * inv;               dir is d; `u = b1` written out says what stands there
class CommonTexts {
public:
    /// What it is given has to stay.
    CommonTexts(const BySide<SideOfPair>& pair, const Dialect& dialect);

    /// A statement of the side's unit, of today or of the past, in the vocabulary of both.
    std::vector<std::string> translated(const WrittenStatement& statement, Side side, bool in_body) const;

    WeighedWords weighed(const WrittenStatement& statement, Side side, bool in_body) {
        return weigher_.weighed(translated(statement, side, in_body));
    }

    /// What a statement of today was before: like that one without its component, where that one is.
    std::vector<std::string> past_of(size_t index, const WrittenStatement& before, Side side) const;
    WeighedWords weighed_past_of(size_t index, const WrittenStatement& before, Side side) {
        return weigher_.weighed(past_of(index, before, side));
    }

    /// A translated statement with the values of such locals in their place that are set once, without round brackets.
    std::vector<std::string> written_out(const std::vector<std::string>& words, Side side) const;

    /// True if the other side once had what stands here today: then that side has gone on from it.
    bool other_had(Side side, size_t index) const { return had_[other(side)].contains(sides[side].words[index]); }

    /// True if a translated statement uses a local whose value can be written out and that the other side does not
    /// have.
    bool uses_new_local(Side side, const std::vector<std::string>& words) const;

    /// True for words that say which thread runs.
    static bool name_thread(const std::vector<std::string>& words);

    /// True for a unit that is run by many threads at once: it asks which one it is.
    bool asks_for_thread(Side side) const;

    /// What the unit across from this side knows.
    KnownThere known_there(Side side) const;

    /// The share of the words that stand in statements that both sides have today.
    float alike() const;

    BySide<ReadSide> sides;
    BySide<std::set<std::string>> own_names;                       ///< parameters and locals
    BySide<std::map<std::string, std::vector<std::string>>> held;  ///< what locals hold that are set once
    BySide<std::set<std::vector<std::string>>> said;               ///< today's statements, as written_out() has them
    BySide<WordsOfSide> unit_words;

private:
    /// The words of the past have a say in what names mean, too.
    void read_meaning();
    void read_side(Side side);
    void read_past(Side side);

    /// The names in the parentheses of a unit's head, and those of parameters and locals, as translated() has them.
    std::vector<std::string> parameters_of(Side side) const;
    std::set<std::string> locals_of(Side side) const;

    /// Parameters stand for each other by their places where the sides are more alike so: `u0, u1` for `u1, u2`.
    void learn_parameters();

    /// Names that one side has and the other does not, where they stand in statements that are otherwise one: the
    /// target's word becomes the source's.
    void learn_names();

    /// Statements that do for one component after another what the other side does for all of them say what that says.
    ///
    ///     c . r = c . r * k ;  c . g = c . g * k ;  c . b = c . b * k ;       c = c * k ;
    void join_components(Side side);
    void find_new_locals(Side side);

    /// What the locals hold that are set once, where they are declared, and the statements with those written out.
    void find_held_values(Side side);

    const BySide<SideOfPair>& pair_;
    const Dialect& dialect_;
    BySide<Language> languages_ = {};
    BySide<std::vector<std::string>> past_words_;
    BySide<Words> past_, now_;
    std::optional<Meaning> meaning_;
    BySide<std::map<std::string, std::string>> names_;
    BySide<std::set<size_t>> joined_;  ///< statements without their component
    Weigher weigher_;
    std::set<std::string> types_;                     ///< names of types, of both sides, as the units declare by them
    BySide<std::set<std::string>> new_locals_;        ///< no parameters, and nothing that the other unit names, too
    BySide<std::set<std::vector<std::string>>> had_;  ///< statements that a side had and has no more
};

/// The statement that says most nearly the same.
struct Nearest {
    size_t index = 0;
    float distance = 0;
    bool any = false;
};
Nearest nearest(const WeighedWords& one, const std::vector<WeighedWords>& among);

/// A statement of few words stands anywhere by chance: how much one of this weight tells, 0 to 1.
inline float told_by(float weight) { return std::min(1.0f, weight / 5.0f); }

}  // namespace porttool

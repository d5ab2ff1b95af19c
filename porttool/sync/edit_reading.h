// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "porttool/sync/named_values.h"
#include "porttool/sync/transplant.h"

namespace porttool {

/// The three texts that an edit is carried by, and what can be said of them: what stands for what, how the target says
/// words of the source, and where the target goes ways of its own, so that nothing is sure.
class EditReading {
public:
    static constexpr size_t kNothing = Alignment::kNone;

    EditReading(const EditTexts& texts, const EditTranslator& translator,
                const std::function<std::string(size_t)>& written);

    const Clause& before(size_t c) const { return texts_.before.clauses[c]; }
    const Clause& now(size_t c) const { return texts_.now.clauses[c]; }
    const Clause& target(size_t c) const { return texts_.target.clauses[c]; }
    size_t counterpart(size_t c) const { return texts_.across.clause_of[c]; }
    size_t word_of(size_t i) const { return texts_.across.word_of[i]; }

    CarriedWords carry_old(size_t first, size_t end) const;
    CarriedWords carry_new(size_t first, size_t end) const;
    /// True if the target's words [first, end) say just that; with `values` numbers of one value are the same.
    bool says(size_t first, size_t end, const std::vector<CarriedWord>& words, bool values = false) const;
    /// True for a statement that the target has more often than the source: one of them may not be all.
    bool is_said_more_often(size_t was, size_t there) const;
    /// True for one of several statements side by side that differ in names alone, where the source has one, in a loop
    /// maybe: `o . r = clamp ( o . r ) ; o . g = clamp ( o . g ) ;` for `c [ k ] = clamp ( c [ k ] ) ;`.
    bool is_one_of_like(size_t was, size_t there) const;
    bool stands_for_something(size_t there) const;
    /// Where the target says the words of the source's old text, word for word, once on both sides.
    std::optional<size_t> only_counterpart(const Clause& old) const;
    /// The statement of the target that stands for none, and says a whole statement of the source's old text so.
    std::optional<size_t> only_statement(size_t c) const;
    /// A word of the target, and whether what stands there resembles what it is asked for.
    struct Nearby {
        size_t word = 0;
        bool is_alike = true;
    };
    /// Near where a clause of the source's old text would stand in the target.
    Nearby near(size_t c) const;
    /// A name that the new words index otherwise than the target always does: a flat array that is one of rows there.
    std::string indexed_otherwise(const std::vector<CarriedWord>& words) const;
    /// True if a clause of the source's old text (`c` may be none) stands in a branch that the port takes on another
    /// condition, or between directives that it has otherwise.
    bool is_doubtful(size_t c) const;
    bool is_doubtful_directive(size_t c) const;

    /// Words as a message quotes them, cut where they are many; names as it lists them.
    static std::string shown(const std::vector<std::string>& words, size_t first, size_t end);
    static std::string listed(std::vector<std::string> words);
    /// The operators of a clause by which it asks, in order: with the same ones a head asks the same way round.
    static std::vector<std::string> comparisons(const AlignedText& text, const Clause& clause);
    static std::vector<std::string> texts_of(const std::vector<CarriedWord>& words);
    /// True for a statement that prints, logs, asserts or asks a clock.
    static bool speaks_to_people(const AlignedText& text, const Clause& clause);

protected:
    const EditTexts& texts_;
    const EditTranslator& translator_;
    const std::function<std::string(size_t)>& written_;
    std::vector<size_t> origin_;  ///< of each clause of now, the one before
    NamedValues named_values_;

private:
    /// Where the target says the words, if it does so once.
    std::optional<size_t> only_place_of(const std::vector<CarriedWord>& words) const;
    size_t times_in_source(const Clause& clause) const;
    double resemblance(size_t c, size_t there) const;
    /// What stands in the target for another clause of the source's old text that says the same.
    size_t counterpart_of_same(size_t c) const;
    size_t says_rare_name_of(size_t c, size_t place, bool gone = false) const;
    /// Branches that the port takes on another condition, or that may be the other ones of two: what stands in them
    /// there is not known.
    void find_doubtful();

    std::vector<bool> in_doubtful_directive_;  ///< clauses of the source's old text
    std::vector<bool> doubtful_;               ///< heads of the source's old text
    std::set<size_t> stands_for_;              ///< clauses of the target that have a counterpart
};

}  // namespace porttool

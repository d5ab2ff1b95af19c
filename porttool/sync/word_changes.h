// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/sync/edit_reading.h"
#include "porttool/sync/inserted_uses.h"
#include "porttool/sync/port_manner.h"

namespace porttool {

/// A run of words that the edit took away, and the run that came in its place.
struct Hunk {
    size_t first = 0, end = 0;          ///< before
    size_t now_first = 0, now_end = 0;  ///< now
    bool is_word_for_word() const { return end == first + 1 && now_end == now_first + 1; }
};

/// Carries what changed in a clause into the clause of the target that stands for it: each changed word to the words
/// that stand for it there.
class WordChanger : EditReading {
public:
    WordChanger(const EditReading& reading, const InsertedUses& uses, Transplant& out)
        : EditReading(reading), uses_(uses), manner_(reading), out_(out) {}

    std::vector<Hunk> hunks_of(const Clause& was, const Clause& is) const;
    /// True if all that changed are spellings of words that the target spells as the source did, and new ones that it
    /// knows.
    bool respells(const std::vector<Hunk>& hunks) const;
    /// A clause is changed as a whole or not at all.
    void change_words(const std::vector<Hunk>& hunks, size_t was, size_t is, size_t there);
    /// Spellings alone that the target has as the source had them.
    std::vector<WordsReplaced>& respelled() { return respelled_; }

private:
    /// A clause of the target with what replaces words of it, from the `made`-th replacement on.
    std::vector<std::string> result_of(const Clause& clause, size_t made) const;
    void change_run(Hunk hunk, size_t was, size_t there);
    void change_words_of(Hunk hunk, size_t was, size_t there);
    /// True for `const` and `restrict` alone that came or went.
    /// True for words of which some qualify pointers alone.
    bool says_restrict(const Hunk& hunk) const;
    bool says_no_value(const Hunk& hunk) const;
    void put(const Hunk& hunk, size_t first, size_t end, const CarriedWords& now);
    /// A function of the port's own that would go for a name which nothing there has, where the port says what changes
    /// in other words than the source: `image -> Set ( data ,` for `set (`; "" for none.
    std::string own_idiom(const Hunk& hunk, size_t first, size_t end, const CarriedWords& now) const;
    /// True for words of a head that hand a value back, where what the port would have of them does not.
    bool loses_way_out(const Hunk& hunk) const;
    /// True where both sides have one name, of a function or of a value, which neither declares, and the source has a
    /// new one throughout: what both have from elsewhere was renamed there.
    bool is_renamed_elsewhere(const Hunk& hunk, size_t first, size_t end) const;
    /// Words that each stand for one of the target's are replaced there, whatever stands around these.
    bool replace_run(const Hunk& hunk);
    /// Arguments or parameters that go, with a comma on one side, go from wherever the target has just these: what
    /// follows them there may be its own.
    bool drop_elements(const Hunk& hunk);
    /// A parameter that goes is the one of its name there, of whatever type.
    bool drop_parameter(const Hunk& hunk);
    size_t start_of_parameter(size_t name) const;
    /// True if a word of the source and the one that stands for it are of a kind: both names, or the same.
    bool says_alike(size_t i) const;
    /// True where the target picks the word of something that the source does not name: `std :: max` for `max`.
    bool has_own_prefix(size_t i, size_t there) const;
    /// True if nothing of the target's own stands beside words that are taken away: they may belong together there.
    bool stands_between_counterparts(const Hunk& hunk, size_t first, size_t end) const;
    /// Where a word of the target begins with the scope that it is called in: `std` of `std :: sqrt`, not before
    /// `first`.
    size_t before_scope(size_t first, size_t word) const;
    /// New words go between the nearest words that stand for some of the target's, if it has nothing of its own there.
    /// Else an argument goes beside the one that it stands beside in the source.
    bool insert_run(Hunk hunk, size_t was, size_t there);
    /// True for new words that begin, or end, with what joins them to a value beside them which the target has not:
    /// `- 1` behind `n` of `int lo = 0 , hi = n ;`, where the target has `int first = 0 ;`.
    bool goes_on_from_missing(const Hunk& hunk) const;
    /// New words of a list, moved to where an element begins or its comma stands: `a , const B b` in front of `const C`
    /// may as well have come as `B b , const` behind `const`. Not to before `first`.
    Hunk from_start_of_element(Hunk hunk, size_t first) const;
    /// Where the element of a list begins that has the word at `end`, with what the target has before it, as
    /// `__global float * a` for `float * a`: not before `first`, kNothing where none begins from there on.
    size_t start_of_element(size_t first, size_t end) const;
    /// Where the element of a list ends that the word before `first` is of, as `a [ 0 ]` for `a`; kNothing where none
    /// ends up to `end`.
    size_t end_of_element(size_t first, size_t end) const;
    /// True for a field that a constructor comes to initialize behind one which the target's does not: it may be
    /// another class's.
    bool initializes_beside_other(const Hunk& hunk) const;
    /// True for an accessor that the target says otherwise: `aux .` is `aux ->` there, and `aux . set . x` is not.
    bool picks_otherwise(size_t i) const;
    /// True for a new parameter that would come behind another one than in the source, which the target has elsewhere
    /// under the same name or one that begins so.
    bool stands_behind_other(const Hunk& hunk, size_t place) const;
    /// The name of the parameter that ends before word `i`; "" for none.
    static std::string parameter_before(const std::vector<std::string>& words, size_t i);
    /// True for names of which one begins with the other.
    static bool are_called_alike(const std::string& a, const std::string& b);
    /// Where the target's parameter ends that is called as the one before new ones; kNothing for none, or several.
    size_t end_of_parameter_before(const Hunk& hunk) const;
    /// `A ,` in front of the next is `, A` behind the one before.
    static CarriedWords with_comma_in_front(CarriedWords element);
    /// Behind which word a new enumerator comes where the target lists them in another order: behind the one that
    /// stands before it in the source; kNothing where that is not told.
    size_t place_of_enumerator(const Hunk& hunk) const;
    /// True for a parenthesis that went, and that the target never had.
    bool is_idle_bracket(const Hunk& hunk) const;
    /// True for an edit of words that have no counterpart on the other side, or mean the same there: scopes, address
    /// spaces, spellings.
    bool is_neutral(const Hunk& hunk) const;
    /// True for a function that the target takes from a scope of its own, and that the source spells otherwise now as
    /// nothing there does: `sycl :: sin` stays where `sin` became `sinf`.
    bool is_of_own_scope(const Hunk& hunk) const;
    /// True for a whole number that became a real one, where the target gives it to a function that takes whole ones:
    /// `pown ( x , 2 )` takes no `2.0`, as `pow` does.
    bool takes_whole_numbers(const Hunk& hunk, size_t first) const;
    /// Beside what changes in a clause a new spelling is due as well: `atan ( y / x )` that became `atan2 ( y , x )`
    /// is no `atan ( y , x )`, though both names mean the same.
    void take_spellings(const std::vector<Hunk>& hunks, size_t first_spelling);
    /// True if the target spells the words that went as the source did.
    bool is_spelled_alike(const Hunk& hunk) const;
    /// A neutral edit of words that the target spells as the source did.
    void respell(const Hunk& hunk);
    /// True for numbers of which one has a mark of its type and the other has none: the target has its own manner.
    bool marks_otherwise(const Hunk& hunk) const;
    /// `std :: min` for `min` that the target spells as the source did.
    void put_scope(const Hunk& hunk);
    /// True where one name stands for one name, of which nothing else is known.
    bool is_name_alone(const Hunk& hunk, size_t first, size_t end) const;
    /// True if a type is exchanged of which the target has more words: `int` in `unsigned int`.
    bool cuts_type(const Hunk& hunk, size_t first, size_t end) const;
    /// True where a text became another, and the target's is near enough to become that as well.
    bool is_text_alike(const Hunk& hunk, size_t first, size_t end) const;
    /// Changes a text of the port's own words as the source's changed, where none that comes in is of one side alone.
    bool change_text_alike(const Hunk& hunk, size_t first, size_t end);
    void leave_run(const Hunk& hunk, size_t target_word, const std::string& why);
    void leave(std::string message, size_t source_word, size_t target_word);

    const InsertedUses& uses_;
    PortManner manner_;
    Transplant& out_;
    std::vector<WordsReplaced> respelled_;
};

}  // namespace porttool

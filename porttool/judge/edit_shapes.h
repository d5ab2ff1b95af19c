// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What an edit looks like, told by the statements that a finding shows of it, each behind `-` or `+`.
#pragma once

#include <compare>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace porttool {

/// The words and signs of a statement as it is shown.
std::vector<std::string_view> shown_words(std::string_view text);

/// True of more than a word or two: few words may be edited alike by chance. One statement that took the place of
/// another is told by what is left between their common begin and end.
bool is_long_edit(const std::vector<std::string>& lines);

/// True of an edit of a dozen words or more, which nobody makes by mistake.
bool is_work(const std::vector<std::string>& lines);

/// True for an edit that did nothing but put parts of a unit into branches for the compiler, or take them out:
/// `# ifdef A` and `# endif` came.
bool is_of_branches(const std::vector<std::string>& lines);

/// The types that a function's head no longer takes, and those in their place, where its edit did nothing else; "" for
/// any other edit, and where one of them is a language's own.
///
///     - void @(Array < T > out, const Array < T > in)
///     + void @(Param < T > out, CParam < T > in)              "Array > CParam Param"
std::string types_exchanged(const std::vector<std::string>& lines);

/// The name that a function takes, or hands on to what it calls, and did not before, or no longer, where its edit did
/// nothing else; "" for any other edit.
///
///     - void @(Args * args)        + void @(Args * args, State * state)
///     - march(args)                + march(args, state)                         "+ state"
std::string handed_on(const std::vector<std::string>& lines);

/// What an edit did at one spot: the words that went there and those that came.
struct EditSpot {
    std::string text;      ///< `get_int > get_int_b2`
    size_t words = 0;      ///< names, numbers and `#`
    bool of_call = false;  ///< one function is called in the place of another, of the same arguments

    auto operator<=>(const EditSpot& other) const { return text <=> other.text; }
    bool operator==(const EditSpot& other) const { return text == other.text; }
};

/// The spots of an edit, each once; none of an edit that is too long to be told apart.
///
///     - v = get_int(b->qs, i)           `get_int > get_int_b2`
///     - # if ARCH >= 61 int sum = 0     `# if ARCH > = 61 >`
///     + v = get_int_b2(b->qs, i)
///     + int sum = 0
std::set<EditSpot> spots_of(const std::vector<std::string>& lines);

/// What an edit, or two edits that differ, did beside the names in it.
struct EditShape {
    std::string text;                ///< with names numbered; "" of an edit so short that it may be alike by chance
    std::vector<std::string> names;  ///< by their numbers
};

EditShape shape_of_edit(const std::vector<std::string>& lines);

/// True if the names of two edits of one shape differ only as the names of the two units do.
///
///     post_left     left_buffer kLeft n
///     post_top      top_buffer kTop n          they do; `left_buffer kTop n` does not
bool names_tell_apart(const std::vector<std::string>& names, std::string_view unit,
                      const std::vector<std::string>& other_names, std::string_view other_unit);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "porttool/language/language.h"

namespace porttool {

using Roles = uint64_t;

/// What a word of the languages is to whoever reads a text: bits of Roles. Each names one question that is asked.
enum WordRole : Roles {
    // Statements.
    kBlockHead = 1ull << 0,      ///< heads a block that is laid beside others by this word
    kControls = 1ull << 1,       ///< has a condition in parentheses, and controls the one statement after it
    kLoopHead = 1ull << 2,       ///< its parentheses hold the clauses of a loop
    kConditionHead = 1ull << 3,  ///< its parentheses hold a condition, which may declare
    kOwnScope = 1ull << 4,       ///< what its parentheses declare holds for the block after them
    kGoesOn = 1ull << 5,  ///< within a function; after a brace in the first column no sign that the brace is lost
    // Heads, and what is declared outside of functions.
    kNoFunctionName = 1ull << 6,    ///< stands before a parenthesis without naming a function
    kTakesArguments = 1ull << 7,    ///< an attribute: the parenthesis after it is its own
    kTrailer = 1ull << 8,           ///< stands between a parameter list and the body
    kOpensType = 1ull << 9,         ///< begins a type with a body
    kRecord = 1ull << 10,           ///< begins one in the languages of C's family, or names one: `struct Ray r`
    kLabel = 1ull << 11,            ///< stands before a colon in a class
    kConstant = 1ull << 12,         ///< makes a variable with a value a constant
    kNoConstant = 1ull << 13,       ///< a statement that begins with it declares no constant
    kBlockStorage = 1ull << 14,     ///< before the name of a block of variables: `uniform Camera {`
    kKernel = 1ull << 15,           ///< makes a function a kernel
    kKernelAttribute = 1ull << 16,  ///< so within an attribute's brackets
    kKernelMacro = 1ull << 17,      ///< so within a macro that makes the function's head
    // Declarations in bodies and parameter lists.
    kNoType = 1ull << 18,            ///< neither a type nor a declared name
    kQualifier = 1ull << 19,         ///< stands in a declaration before its type or after it
    kSoftQualifier = 1ull << 20,     ///< qualifies a type in one language and may be a name in another
    kGroupedQualifier = 1ull << 21,  ///< a qualifier with arguments in parentheses
    kType = 1ull << 22,              ///< a type in whatever language
    kTypePart = 1ull << 23,          ///< one word of several that make a number's type: `unsigned long int`
    kTypeOfVectors = 1ull << 24,     ///< with `2`, `4` or `3x3` after it a type, too
    kTypeOfValue = 1ull << 25,       ///< with a value in parentheses after it a type: `decltype(x)`
    // What a word means on the other side.
    kDropped = 1ull << 26,          ///< has no counterpart there, and is left out
    kReserved = 1ull << 27,         ///< of those, what is nobody's name in any language
    kSharedStorage = 1ull << 28,    ///< a variable of a group of threads
    kConstantStorage = 1ull << 29,  ///< one that never changes
    kNumberType = 1ull << 30,       ///< a type that numbers are cast to and that goes by no other name elsewhere
    kKeyword = 1ull << 31,          ///< structures a text in every language: measures take it for no name
    kShapeWord = 1ull << 32,        ///< likewise where units are paired by their shapes
    // What an edit of one side alone means.
    kPromise = 1ull << 33,        ///< says something of a name and changes no value, wherever it stands
    kHeadPromise = 1ull << 34,    ///< the same in a function's head: how it is called or linked, what it may assume
    kIdleAttribute = 1ull << 35,  ///< the same as an attribute: in brackets, or an argument of `__attribute__`
    kLoop = 1ull << 36,           ///< heads a loop
};

/// The roles that a word has in every language; 0 for what is only a name.
Roles roles_of(std::string_view word);

/// The roles that a word has in `language`.
Roles roles_of(std::string_view word, Language language);

/// True if the word has one of `roles` in every language.
inline bool word_is(std::string_view word, Roles roles) { return (roles_of(word) & roles) != 0; }

/// True for types, and for vectors and matrices of them: `float`, `uint3`, `mat4x3`.
bool is_type_word(std::string_view word);

/// The words that have a role in every language, in the order of the table.
std::vector<std::string_view> words_with(WordRole role);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/scan/token.h"

namespace porttool {

/// True for `#define NAME(`: the parameter list follows the name, the token `name`, without a blank.
bool is_function_like(const LexedText& lexed, uint32_t name);

/// A function-like macro of the file, for names that are built by macros.
struct Macro {
    std::vector<std::string> parameters;
    std::vector<std::string> replacement;  ///< token by token
};

using MacroTable = std::map<std::string, Macro, std::less<>>;

/// The function-like macros that a file defines and that paste tokens or name a function in their replacement.
MacroTable read_macros(const LexedText& lexed);

/// The replacement of `macro` with `arguments` put in and `##` carried out, token by token. One level only.
std::vector<std::string> expand(const Macro& macro, const std::vector<std::string>& arguments);

/// The macros of a file that take an argument as it is spelled, not for its value: `#x`, `a##x`, or by handing it on to
/// such a macro. Sorted.
std::vector<std::string_view> spelling_macros(const LexedText& lexed);

/// True for a macro in the place of a word that structures texts or names a type of C: `#define float double`. What it
/// touches means something else, with not a word of it edited.
bool redefines_word(std::string_view macro);

/// True if the macro defines something by itself: the lines after it are no part of it.
bool defines_something(const MacroTable& macros, std::string_view macro);

/// True for `#define STRUCT(NAME) struct NAME`.
bool opens_type(const MacroTable& macros, std::string_view macro);

/// What a macro with its arguments makes of the head of a function or type.
struct MadeHead {
    std::string name;
    bool kernel = false;  ///< the macro says so
};

/// By the macro's definition if the file has it, else the name is made of the arguments: `KERNEL(shade)(int a) {`.
/// `whole_head`: nothing else stands in the head, as in `KERNEL(shade, int a) {`.
MadeHead head_made_by(const MacroTable& macros, std::string_view macro, const std::vector<std::string>& arguments,
                      bool whole_head);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/scan/token.h"

namespace porttool {

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

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// What a file defines under a name: a piece of its text that can be cut out.
struct Definition {
    enum class Kind : uint8_t { Macro, Type, Struct, Constant, Function, Variable };
    Kind kind = Kind::Function;
    const ScannedFile* file = nullptr;
    const Unit* unit = nullptr;  ///< none of a typedef or a variable
    TokenRange tokens;
    std::string name;                  ///< without scopes
    std::string owner;                 ///< the class that it is a member of, without namespaces; "" for none
    std::vector<uint32_t> conditions;  ///< the directives, by their places in the file, that decide whether it counts
    uint32_t open_conditions = 0;      ///< how many `#endif` close them
};

/// True for a macro that is none without arguments in parentheses.
bool takes_arguments(const Definition& macro);

/// Where a function ends: after the brace that closes its body.
uint32_t end_of_function(const LexedText& lexed, const Unit& unit);

/// True for a word that every file means the same by, whatever some header makes of it for old compilers.
bool is_fixed_word(std::string_view word);

/// All that a file defines: units, macros, tables, types and variables. The file has to stay.
std::vector<Definition> pieces_of(const ScannedFile& file);

/// The other names of a piece: `param_t` of `typedef struct param {...} *param_t;`, the values of an enum.
std::vector<std::string> further_names(const Definition& one);

}  // namespace porttool

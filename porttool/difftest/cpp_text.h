// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "porttool/difftest/closure.h"

namespace porttool {

/// What is asked of a piece beyond its text.
struct CppManner {
    const std::set<std::string, std::less<>>* namespaces = nullptr;  ///< scopes that are left out
    const std::set<std::string, std::less<>>* fields = nullptr;      ///< of structs: no names of components
    Language language =
        Language::Unknown;                 ///< of the function that is run: a header that it shares with C++ is read so
    bool widens = false;                   ///< floats become doubles, to tell rounding from a difference
    std::string rename;                    ///< what the function of the piece is called; "" for its own name
    std::string_view recursive = {};       ///< the name by which that function calls itself; "" where it does not
    std::optional<std::string> body = {};  ///< in the place of the function's own
};

/// True for a word that C has no meaning for and C++ has: the name of something, with a `_` behind it as C++ has it.
bool is_name_in_c(std::string_view word, Language language);

/// The text of a definition as C++, whatever its language: without words that only device code has, with the
/// components of vectors, literals and `out` parameters as C++ has them. Lines are kept apart where it has directives.
std::string cpp_text(const Piece& piece, const CppManner& manner);

/// Some text that counts where a definition does: between the lines of the preprocessor that it stands under.
std::string under_conditions(const Definition& one, std::string text, const CppManner& manner);

/// True for a function that conditions of the preprocessor decide about; not for one of whose two heads they take one.
bool is_conditional(const Definition& function);

/// The declaration of a function; "" where it has one that cannot stand apart: a template, or with a default.
std::string prototype(const Definition& function, const CppManner& manner);

/// The same of some tokens of a file.
std::string cpp_text_of(const ScannedFile& file, TokenRange range, const CppManner& manner);

/// The lines that undo what a piece defines for the preprocessor; "" for others.
std::string undone(const Definition& definition);

}  // namespace porttool

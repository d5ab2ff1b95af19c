// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/scan/unit.h"
#include "porttool/text/fingerprint.h"

namespace porttool {

/// What a file says of a word outside of units.
struct DeclaredWord {
    enum class Kind : uint8_t {
        Type,        ///< `using real = float;`, `typedef float real;`, `namespace fast = approximate;`
        Brought,     ///< `using fast::sqrtf;`
        Opened,      ///< `using namespace fast;`, `inline namespace fast {`: the word is the namespace
        Declared,    ///< a variable, or the declaration of a function: `float (*sqrtf)(float) = &rough;`
        Linked,      ///< a declaration that says what is called in its place: `float sqrtf(float) __asm__("rough");`
        Attributed,  ///< an attribute of a function's declaration that may change what it does: `weak`,
                     ///< `optimize("O1")`
        Macro,       ///< `#define sqrtf rough`
        Pragma,      ///< `#pragma redefine_extname sqrtf rough`, `#pragma pop_macro("sqrtf")`, `omp declare variant`
    };
    uint32_t name_token = 0;
    Kind kind = Kind::Declared;
    TokenRange tokens;                         ///< of the statement; of an attribute its own
    Print print;                               ///< of their words and where it stands; of an attribute the name's, too
    std::shared_ptr<const std::string> scope;  ///< the namespaces around it, as `a::b::`
};

/// Of a file, in order. Takes time in line with the file.
std::vector<DeclaredWord> declared_words(const ScannedFile& file);

/// The word that is meant: that of a pragma may stand in quotes.
std::string_view word_of(const ScannedFile& file, const DeclaredWord& declared);

/// The statement as a message has it, its tokens apart by blanks; the end of a long one is left out.
std::string text_of(const ScannedFile& file, const DeclaredWord& declared);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/language/language.h"

namespace porttool {

/// What several languages have and others have not, as more than one room asks for it. Each has a row in language.cpp.
struct LanguageAbilities {
    Language language = Language::Unknown;
    bool std_library = false;    ///< that of C++
    bool c_libraries = false;    ///< what a library of C or C++ has may be called from its host code
    bool references = false;     ///< `T&`, and templates, as C++ has them
    bool pointers = false;       ///< `T*`
    bool macros = false;         ///< `#define`
    bool vectors = false;        ///< of its own: their parts have names for colours, too, `dot` is a function
    bool is_of_devices = false;  ///< for kernels or shaders alone; many of these have no `double`
};

const LanguageAbilities& abilities_of(Language language);

}  // namespace porttool

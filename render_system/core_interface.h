// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>  // the compiler's library says which one it is

// For the sources alone that are compiled with PATHTRACER_SEAM (cmake/core_module.cmake).

#define PATHTRACER_TEXT_OF(macro) #macro
#define PATHTRACER_TEXT(macro) PATHTRACER_TEXT_OF(macro)

namespace render_system {

/// What program and module have to agree on to call each other in C++: a number, to be raised when a call means
/// something else; the texts of the headers that both include, as a digest, so that no change of a layout or of the
/// order of functions is forgotten; the compiler, and what of its library changes layouts.
constexpr const char* core_interface() {
    return "1, headers " PATHTRACER_SEAM ", compiler " __VERSION__ ", C++ ABI " PATHTRACER_TEXT(
        __GXX_ABI_VERSION) ", libstdc++ " PATHTRACER_TEXT(_GLIBCXX_RELEASE) "." PATHTRACER_TEXT(_GLIBCXX_USE_CXX11_ABI)
#ifdef _GLIBCXX_DEBUG
        " debug"
#endif
        ;
}

}  // namespace render_system

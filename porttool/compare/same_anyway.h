// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// A function's text with what its values are given to or handed over as written in one manner:
///
///     float x = 0 ;  x = ( float ) n ;               x = n ;              the cast is the one that `x` asks for
///     size_t @ ( ) { return ( size_t ) n ; }         return n ;
///     void @ ( const float & k , T const & v )       void @ ( float k , T v )
///
/// A name that a text declares more than once has no type here. A reference to a constant is a value as long as nobody
/// writes what it refers to, which the text does not tell.
Words with_values_as_taken(const Words& tokens);

/// A text in which conditions of the preprocessor that ask for nothing but versions of a compiler or a runtime
/// (`# if defined ( CUDART_VERSION ) && CUDART_VERSION >= 10010`) are all the same one.
Words with_one_version_condition(const Words& tokens);

/// True for a macro that tells the version of a compiler, a runtime or a library: `__CUDA_ARCH__`, `CUDART_VERSION`,
/// `_MSC_VER`, `TORCH_VERSION_MAJOR`.
bool tells_a_version(std::string_view macro);

}  // namespace porttool

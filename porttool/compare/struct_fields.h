// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// A struct's text with one declarator a field, and sized types as one word.
///
///     struct @ { float3 o , d ; unsigned int k [ 4 ] ; } ;
///     struct @ { float3 o ; float3 d ; uint k [ 4 ] ; } ;
Words single_fields(const Words& tokens);

/// A struct's head and its data: single_fields() without member functions, access words, macros, friends, type names
/// and static members, none of which is part of its layout.
///
///     struct @ : A { public : float3 o , d ; float length ( ) const ; } ;
///     struct @ : A { float3 o ; float3 d ; } ;
Words data_fields(const Words& tokens);

}  // namespace porttool

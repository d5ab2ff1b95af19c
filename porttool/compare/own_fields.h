// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/edits.h"

namespace porttool {

/// True if the edit of a struct only added or took away whole fields that the other struct does not have by name, and
/// of the fields that stayed the other has less than half: the two were never one layout.
///
///     struct @ { int device ; queue q ; bool shared ; } ;        gained `shared`
///     struct @ { int device ; stream s ; void * data ; } ;
bool only_changes_fields_of_its_own(const LoneTexts& texts);

/// The name of the class that a struct derives from now and did not before, or no longer, if its edit did nothing else;
/// "" for any other edit, and for a struct that derives from something both times.
std::string_view only_changes_base(const Words& before, const Words& now);

/// True if all that both sides of a pair of structs did was to add the same fields behind the same field, each of the
/// types that at least two fields have which both had before. A side may write `m_` before its names.
///
///     source    cl_int shadows; cl_int fog;      now also    cl_int glow;
///     port      bool shadows; bool fog;          now also    bool glow;
bool gain_the_same_fields(const PairTexts& texts);

}  // namespace porttool

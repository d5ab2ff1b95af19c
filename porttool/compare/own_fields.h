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

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/difftest/leaves.h"
#include "porttool/difftest/subject.h"

namespace porttool {

/// Every word by which what a function needs may be looked at, fields among them.
std::set<std::string, std::less<>> words_of_side(const Closure& closure);

/// True where a function, or what it calls, may write to one of the variables that are inputs.
bool may_write_to_variable(const Subject& subject, std::string_view name);

/// What the texts of one side name, and which of its parameters they never write to.
TextOfSide text_of_side(const Subject& subject);

}  // namespace porttool

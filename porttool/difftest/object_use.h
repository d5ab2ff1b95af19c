// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/difftest/definitions.h"

namespace porttool {

/// True for a member function that needs an object: a constructor, an operator, and one that names something its class
/// or a class that this is made from declares. Others run as functions of their own; where no text has the class, a
/// macro's perhaps, a name that nobody knows will tell.
bool uses_its_object(const Definition& function, const Definitions& definitions);

}  // namespace porttool

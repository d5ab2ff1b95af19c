// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/scan/head.h"
#include "porttool/scan/head_items.h"

namespace porttool {

/// Reads a head that is neither a scope's nor a type's nor a block's: fills `head` in if it is a function's, or a
/// macro's that makes a type; else leaves it as it is.
void read_function_head(const HeadItems& items, Head& head);

}  // namespace porttool

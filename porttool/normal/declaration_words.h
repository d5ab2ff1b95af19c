// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "porttool/text/is_one_of.h"

namespace porttool {

/// A word without small letters, as macros have.
bool is_shouted(std::string_view text);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace porttool {

/// YYYY-MM-DD; SOURCE_DATE_EPOCH overrides the clock. Throws CannotDo where that is no time.
std::string today();

}  // namespace porttool

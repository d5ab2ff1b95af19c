// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace porttool {

/// The name most like `word`, or "" if none is near: for "did you mean".
std::string nearest(const std::string& word, const std::vector<std::string>& names);

}  // namespace porttool

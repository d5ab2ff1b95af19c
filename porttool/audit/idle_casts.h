// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace porttool {

/// Two statements without what only gives a value another type: `static_cast<T>(x)` is `(x)`, and where one name is
/// all that ever takes a number and nothing else, in both together, `Real(2.0)` is `(2.0)`.
std::pair<std::vector<std::string>, std::vector<std::string>> without_idle_casts(const std::vector<std::string>& a,
                                                                                 const std::vector<std::string>& b);

}  // namespace porttool

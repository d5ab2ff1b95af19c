// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/match/match.h"

namespace porttool {

std::string map_json(const Matching& matching);
std::string map_table(const Matching& matching);

/// A line that tells of several ports side by side in the target; empty where there is but one.
std::string ports_line(const Matching& matching);

}  // namespace porttool

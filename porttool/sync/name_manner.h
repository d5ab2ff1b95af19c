// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace porttool {

/// What a new name is called on the other side, by how the names beside it are: `schlick` is `Schlick` there, and
/// `evaluate_lobes` is `EvaluateLobes`, so `sheen_weight` is `SheenWeight`. The same name where most others are the
/// same, or nothing tells.
std::string name_in_manner(const std::string& name, const std::vector<std::pair<std::string, std::string>>& examples);

}  // namespace porttool

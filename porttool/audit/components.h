// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What one side says for a whole vector and the other for one component after another.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace porttool {

/// A statement without the component that it is about: `c = c * k` for `c . r = c . r * k`. Nothing where it names
/// none, or more than one: `c . x = c . y` is no part of `c = c`.
std::optional<std::vector<std::string>> without_component(const std::vector<std::string>& words);

/// Neighbours that do the same for one component after another.
struct ComponentRun {
    size_t first = 0, end = 0;       ///< statements
    std::vector<std::string> whole;  ///< as without_component() has each of them
};
std::vector<ComponentRun> component_runs(const std::vector<std::vector<std::string>>& statements);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace porttool::testing {

/// How a text was edited: not at all, in one place, in every place, or turned around.
enum class EditOf { None, One, All, Order };

/// A text of any length that repeats something: `before`, `open` n times, `middle`, `close` n times, `after`. `{i}`
/// stands for the number of the repetition, `{e}` for what an edit changes.
struct Construct {
    std::string name, before, open, middle, close, after;

    std::string text(size_t repetitions, EditOf edit) const;
    /// How many repetitions give about so many bytes.
    size_t repetitions(size_t bytes) const;
};

/// Those of bench/constructs.json.
std::vector<Construct> read_constructs(const std::string& path);

}  // namespace porttool::testing

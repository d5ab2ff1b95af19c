// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace porttool {

/// A condition that compares two values, or the opposite of one.
struct PlainComparison {
    std::vector<std::string> left, right;
    std::string sign;  ///< `<`, `>`, `<=`, `>=`, `==` or `!=`
    bool is_opposite = false;

    std::vector<std::string> written() const;

    /// Writes it without `>` and `>=`, and what `==` and `!=` compare in order. `turned`: what is meant is the
    /// opposite. With `has_both` what it decides on can be exchanged, so that `<` and `==` are enough.
    void write_plain(bool turned, bool has_both);
};

}  // namespace porttool

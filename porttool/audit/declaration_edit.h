// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What an edit of a declaration may mean to the other side, though neither a name nor an operator changed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace porttool {

/// True where one variable is declared with another value: with other numbers, or another constant in capitals.
///
///     float limit = 1e-4f        float limit = 1e-6f
///     float3 color = 0           float3 color = WHITE
bool declares_another_value(const std::vector<std::string>& before, const std::vector<std::string>& now);

/// How often a statement names an integer of 64 bits or of the size of memory.
size_t wide_integers_in(const std::vector<std::string>& words);

/// True for a statement that multiplies or shifts, or adds what it then stores: what can overflow.
bool can_overflow(const std::vector<std::string>& words);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Statements that say nothing of what a function computes, or hardly anything.
#pragma once

#include <string>
#include <vector>

namespace porttool {

/// True for a variable that is declared without a value, with numbers alone, or as a short name for what another one
/// holds: `float3 n = p -> n`.
bool is_bare_declaration(const std::vector<std::string>& written);

/// True for a statement that asks a runtime to copy, clear, make or give back memory, or waits for a device.
bool moves_memory(const std::vector<std::string>& words);

/// True for a local that says how many threads run together or how much memory they share: `block_size = 256`.
bool sizes_launch(const std::vector<std::string>& words);

/// True for a call that makes two values change places.
inline bool is_swap(const std::vector<std::string>& words) {
    return words.size() > 3 && words[0].ends_with("swap") && words[1] == "(";
}

/// True for `return` with nothing but the way to a value.
bool is_bare_return(const std::vector<std::string>& written);

/// True for a statement that speaks to people or to the build: it prints, logs, asserts, measures time, or is a
/// preprocessor line.
bool is_aside(const std::vector<std::string>& words);

/// True for an aside, a declaration without a value, a lone `else` and the head of the unit, whose name is `@` there.
bool says_nothing(const std::vector<std::string>& written);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "porttool/language/language.h"

namespace porttool {

/// A file of difftest/prelude, which the program carries within itself: "vectors.h", "harness.h".
std::string_view prelude_file(std::string_view name);

/// The functions that vectors.h defines: a project's own overloads of them stand beside these.
const std::set<std::string, std::less<>>& prelude_names();

/// True for the name of a built-in vector or matrix: `float3`, `uvec2`, `mat4`.
bool is_vector_type(std::string_view word);

/// True for languages that have vectors and their operators built in.
bool has_vector_types(Language language);

/// True for a function or a type that vectors.h defines.
bool is_prelude_word(std::string_view word);

}  // namespace porttool

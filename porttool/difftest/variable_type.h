// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/difftest/defined_pieces.h"

namespace porttool {

/// What a variable holds, as C++ declares it.
struct VariableType {
    std::string name;       ///< `unsigned int`; "" for what no run can make, as a pointer to pointers or a template's
    std::string bounds;     ///< `[3][4]` of an array
    bool leads_on = false;  ///< to an array whose length the declaration does not tell: `float* rows`, `vec4 rows[]`

    /// One value, not many.
    bool is_single() const { return !name.empty() && !leads_on && bounds.empty(); }
};

/// Reads the declaration of a variable, also of one behind others: `b` of `int a = 1, b[3];`.
VariableType type_of_variable(const Definition& variable);

/// `float* rows;`
std::string declaration_of(const Definition& variable);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/difftest/cpp_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// A parameter of a function that is run.
struct SubjectParameter {
    std::string name;
    bool is_pointer = false;
    bool is_reference = false;
    bool can_be_array = false;  ///< a pointer to numbers, of whatever length
    bool is_guess = false;      ///< how many there are behind the pointer, the function's other arguments say
    int elements = 1;           ///< behind a pointer, as far as the function looks
    std::string bound;          ///< of an array, as written; "" for none
    bool is_untyped = false;    ///< a `void*`
    bool is_file = false;       ///< a `FILE*`
    std::string behind;         ///< of a `void*` what the function takes it for: a type; "" where it does not say so
};

/// The parameters of a function, in their order; how many elements are behind a pointer is not looked for.
std::vector<SubjectParameter> parameters_of(const ScannedFile& file, const Unit& unit, const CppManner& manner);

}  // namespace porttool

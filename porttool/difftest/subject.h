// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "porttool/difftest/closure.h"

namespace porttool {

/// A parameter of a function that is run.
struct SubjectParameter {
    std::string name;
    bool is_pointer = false;
    int elements = 1;   ///< behind a pointer, as far as the function looks
    std::string bound;  ///< of an array, as written; "" for none
};

/// Functions of one side that others stand in for, because they read what a run does not have (a table, a texture), by
/// the number under which both sides answer alike.
using StandIns = std::map<const Definition*, int>;

/// One side of a pair, ready to be written as C++.
struct Subject {
    const Definition* function = nullptr;
    Closure closure;
    std::vector<SubjectParameter> parameters;
    std::string template_arguments;     ///< "<float>" for a template; "" for others
    std::vector<std::string> stood_in;  ///< names of functions that were stood in for
    std::string reason;                 ///< why it cannot be run; "" if it can
};

/// Looks at a function. Never fails: `reason` says why it cannot be run.
Subject subject_of(const Definition& function, const Definitions& definitions, const StandIns& stand_ins);

/// The subject as a part of a program: in a namespace of its own, `subject_N`. `widens`: with doubles for floats.
std::string subject_text(const Subject& subject, int number, const Definitions& definitions, const StandIns& stand_ins,
                         bool widens = false);

}  // namespace porttool

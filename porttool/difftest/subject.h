// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/difftest/closure.h"
#include "porttool/difftest/cpp_text.h"
#include "porttool/difftest/parameters.h"
#include "porttool/difftest/stand_ins.h"

namespace porttool {

/// Elements of an array whose length is a guess, and the largest whole number that goes with it: a count, or an index.
inline constexpr int kGuessedElements = 64;
inline constexpr int kGuessedCount = 8;

/// One side of a pair, ready to be written as C++.
struct Subject {
    const Definition* function = nullptr;
    Closure closure;
    std::vector<SubjectParameter> parameters;
    std::string template_arguments;              ///< "<float>" for a template; "" for others
    std::set<int> stood_in;                      ///< the numbers of what was stood in for
    std::set<std::string, std::less<>> named;    ///< of those, the ones by a name
    bool has_notes = false;                      ///< some of those give nothing: what they are called with is compared
    std::vector<const Definition*> variables;    ///< that are inputs, by name
    std::set<std::string, std::less<>> given;    ///< of these, the ones that either side may write to: outputs
    std::map<std::string, std::string> assumed;  ///< macros that nobody defines, and without which it is not there
    std::string reason;                          ///< why it cannot be run; "" if it can
};

/// How a function's side is written as C++. `fields`: fields_in() of its closure; they and `definitions` are looked at
/// later.
CppManner manner_of(const Definition& function, const Definitions& definitions,
                    const std::set<std::string, std::less<>>& fields);

/// The names of the fields of all structs that a function needs.
std::set<std::string, std::less<>> fields_in(const Closure& closure);

/// Looks at a function. Never fails: `reason` says why it cannot be run. `counterpart`: what a template is to be run
/// for follows from the types that stand there.
Subject subject_of(const Definition& function, const Definitions& definitions, const StandIns& stand_ins,
                   const Definition& counterpart);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/difftest/closure.h"

namespace porttool {

/// A parameter of a function that is run.
struct SubjectParameter {
    std::string name;
    bool is_pointer = false;
    bool can_be_array = false;  ///< a pointer to numbers, of whatever length
    bool is_guess = false;      ///< how many there are behind the pointer, the function's other arguments say
    int elements = 1;           ///< behind a pointer, as far as the function looks
    std::string bound;          ///< of an array, as written; "" for none
};

/// Elements of an array whose length is a guess, and the largest whole number that goes with it: a count, or an index.
inline constexpr int kGuessedElements = 64;
inline constexpr int kGuessedCount = 8;

/// What stands in for something that one side of the other does not have either, by a name alone.
struct NamedAnswer {
    int number = 0;
    std::string type;  ///< of the answer, as the other side writes it
};

/// What a run supplies on one side in place of what it does not have: tables, textures, settings.
struct StandIns {
    /// Functions that read such things, by the number under which both sides answer alike.
    std::map<const Definition*, int> functions;
    /// The same where this side has nothing of the name that the scan could see, as a function that a macro makes.
    std::map<std::string, NamedAnswer, std::less<>> named;
    /// Variables of plain data that both sides have under one name: they are inputs.
    std::set<std::string, std::less<>> variables;
};

/// One side of a pair, ready to be written as C++.
struct Subject {
    const Definition* function = nullptr;
    Closure closure;
    std::vector<SubjectParameter> parameters;
    std::string template_arguments;            ///< "<float>" for a template; "" for others
    std::set<int> stood_in;                    ///< the numbers of what was stood in for
    std::set<std::string, std::less<>> named;  ///< of those, the ones by a name
    bool has_notes = false;                    ///< some of those give nothing: what they are called with is compared
    std::vector<const Definition*> variables;  ///< that are inputs, by name
    std::string reason;                        ///< why it cannot be run; "" if it can
};

/// True for a function that gives nothing.
bool gives_nothing(const Definition& function);

/// Looks at a function. Never fails: `reason` says why it cannot be run. `counterpart`: what a template is to be run
/// for follows from the types that stand there.
Subject subject_of(const Definition& function, const Definitions& definitions, const StandIns& stand_ins,
                   const Definition& counterpart);

/// The subject as a part of a program: in a namespace of its own, `subject_N`. `widens`: with doubles for floats.
std::string subject_text(const Subject& subject, int number, const Definitions& definitions, const StandIns& stand_ins,
                         bool widens = false);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What one side calls as a method of a value, and the other as a function of it.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// The functions that some texts call, by the name that a method would have.
class CalledFunctions {
public:
    /// Takes in the calls of a text that are not calls of methods.
    void add(const Words& text);

    /// The function for the method `name`: it is called alike but for capital letters, or so behind a type's name and
    /// an underscore. "" if there is none, or more than one.
    std::string function_for(const std::string& name) const;

private:
    std::map<std::string, std::set<std::string>> by_method_;  ///< by the name in small letters
};

/// Writes calls of methods as calls of the functions that the other side has for them.
///
///     text                         there                          out
///     r = z . Length ( ) ;         length ( z )                   r = length ( z ) ;
///     d = n [ 0 ] . Dot ( a ) ;    Vector_Dot ( p , q )           d = Vector_Dot ( n [ 0 ] , a ) ;
std::vector<std::string> with_functions_for_methods(const Words& text, const CalledFunctions& there);

}  // namespace porttool

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

/// The functions and the methods that some texts call. One stands for the other if they are called alike but for
/// capital letters, or so after a type's name and an underscore.
class CalledForms {
public:
    void add(const Words& text);

    /// The function for the method `name`; "" if there is none, more than one, or a method as well.
    std::string function_for(const std::string& name) const;
    /// The method for the function `name`; "" if there is none, more than one, or a function as well.
    std::string method_for(const std::string& name) const;

private:
    using Names = std::map<std::string, std::set<std::string>>;
    Names functions_, methods_;  ///< by what they are called in small letters, functions also without a type
};

/// A text in other words, each with the word of the text that it is; kMade for those that are none.
struct Reworded {
    static constexpr size_t kMade = static_cast<size_t>(-1);
    std::vector<std::string> words;
    std::vector<size_t> from;
    bool any = false;  ///< something is said otherwise
};

/// Writes calls of methods as calls of the functions that the other side has for them.
///
///     text                         there                          out
///     r = z . Length ( ) ;         length ( z )                   r = length ( z ) ;
///     d = n [ 0 ] . Dot ( a ) ;    Vector_Dot ( p , q )           d = Vector_Dot ( n [ 0 ] , a ) ;
Reworded with_functions_for_methods(const Words& text, const CalledForms& there);

/// Writes calls of functions as calls of the methods that the other side has for them: the other way round. Texts of
/// more than 5,000 words are left as they are.
Reworded with_methods_for_functions(const Words& text, const CalledForms& there);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What is known to give equal values for equal arguments, and to change nothing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/value_graph/values.h"

namespace porttool {

/// A function of mathematics or bits that the languages bring along.
struct PureCall {
    bool is_pure = false;
    std::string name;  ///< its common name
};

/// Whether a call of that name is one.
PureCall pure_call(std::string_view name, const Dialect& dialect);

/// The type of what it gives, as far as its arguments tell; "" if they do not.
std::string type_of_call(const PureCall& call, const ValueTable& table, const std::vector<Value>& arguments);

/// True for names of what never changes while a function runs: a thread's place, pi.
bool is_fixed_name(std::string_view name, const Dialect& dialect);

}  // namespace porttool

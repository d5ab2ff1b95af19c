// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// A place where a function is called, launched as a kernel, or declared apart from its definition.
struct CallSite {
    uint32_t name = 0;                  ///< token
    uint32_t close = 0;                 ///< the token that ends its arguments
    std::vector<TokenRange> arguments;  ///< or parameters
    bool declares = false;
};

/// All in a file but the definition. `of_class`: a method, which calls may pick of an object.
std::vector<CallSite> call_sites(const ScannedFile& file, std::string_view function, bool of_class);

/// What a unit calls by a name alone, in the order of its words: no methods of objects.
std::vector<CallSite> calls_within(const ScannedFile& file, const Unit& unit);

/// True for what stands before a call whose value is taken: an assignment, an operator.
bool takes_value(std::string_view before);

/// What stands between the parentheses of a function's head, parameter by parameter; a lone `void` is none.
std::vector<TokenRange> parameters_of_head(const ScannedFile& file, const Unit& unit);

/// The innermost unit around a token; nullptr outside of any.
const Unit* unit_around(const ScannedFile& file, uint32_t token);

}  // namespace porttool

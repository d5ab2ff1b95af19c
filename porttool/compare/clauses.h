// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace porttool {

/// A statement, the head of a block, or the brace that closes one: what an edit adds, drops or moves as a whole.
///
///     float @ ( float x ) {          0   opens, closed by 3
///     if ( x > 0 ) {                 1   opens, closed by 2, stands in 0
///     }                              2   closes 1
///     }                              3   closes 0
struct Clause {
    static constexpr size_t kNone = static_cast<size_t>(-1);

    size_t first = 0, end = 0;  ///< its words, with the `;` or `{` that ends it
    size_t inside = kNone;      ///< the clause whose block it stands in; a closing brace stands beside its head
    size_t partner = kNone;     ///< of a head its closing brace, and the other way round
    bool opens = false, closes = false;

    size_t size() const { return end - first; }
};

/// Cuts words in normal form into clauses. A brace in an expression, as of an initializer, opens no block; that of a
/// lambda does. `is_record`: of a struct, whose fields are clauses.
std::vector<Clause> clauses_of(const std::vector<std::string>& words, bool is_record);

}  // namespace porttool

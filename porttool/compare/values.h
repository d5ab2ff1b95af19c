// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// Two paired constants by value, or two paired structs by their fields.
struct ComparedValues {
    bool same = false;
    bool certain = false;  ///< no name is left whose meaning lies elsewhere: they differ if `same` is false
    std::string says;      ///< what each side has, as written; for a message
};

/// Compares two units of the same kind, constant or struct, by their tokens in normal form.
///
///     # define @ ( 1 < < 5 )               const uint @ = 32u ;                 the same
///     const float @ = 1 ;                  const float @ = 1.0 ;                the same: the type converts
///     # define @ N                         const int @ = 32 ;                   not the same, and not certain
///     struct @ { float3 o , d ; } ;        struct @ { vec3 o ; vec3 d ; } ;     the same
ComparedValues compare_values(UnitKind kind, const Words& source, const Words& target, const Dialect& dialect);

/// True if `before` and `other` list names, not the same ones, and all that the edit did was to list more of the
/// other's, or to drop some that are not the other's.
///
///     before { A , B }      now { A , B , D }      other { A , B , C , D }
bool list_draws_nearer(const Words& before, const Words& now, const Words& other);

}  // namespace porttool

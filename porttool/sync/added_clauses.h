// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "porttool/sync/edit_reading.h"
#include "porttool/sync/inserted_uses.h"

namespace porttool {

/// Clauses of the source's old text that new ones have to do with.
struct AddedSources {
    std::set<size_t> held;   ///< their successors are left, so that they stay
    std::set<size_t> moved;  ///< they stand elsewhere in the new text
};

/// Carries the clauses that the source gained: each run of them to between the counterparts of its neighbours.
AddedSources carry_added_clauses(const EditReading& reading, const InsertedUses& uses, Transplant& out);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/sync/edit_reading.h"
#include "porttool/sync/inserted_uses.h"

namespace porttool {

/// Carries what changed within clauses that the source kept: into `out` go the words of the target that become others,
/// what is there already, and what is left. Returns edits of spelling alone, which are due only where somebody asks.
std::vector<WordsReplaced> carry_changed_clauses(const EditReading& reading, const InsertedUses& uses, Transplant& out);

}  // namespace porttool

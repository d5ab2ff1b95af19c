// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/brace_edits.h"

namespace porttool {

BraceEdits brace_edits(const UnitWords& was, const AlignedText& before, const UnitWords& is, const AlignedText& now,
                       const Alignment& edit) {
    BraceEdits out;
    for (size_t c = 0; c < before.clauses.size(); ++c) {
        const size_t there = edit.clause_of[c];
        if (there == Alignment::kNone || !before.clauses[c].opens || !now.clauses[there].opens) continue;
        const bool had = !was.is_added(before.clauses[c].end - 1), has = !is.is_added(now.clauses[there].end - 1);
        if (had != has) (has ? out.came : out.went).insert(there);
    }
    return out;
}

}  // namespace porttool

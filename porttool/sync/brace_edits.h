// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "porttool/compare/alignment.h"
#include "porttool/sync/unit_words.h"

namespace porttool {

/// Heads of the source's new text whose blocks have braces since the edit, or have none any more. In normal form every
/// block has them, so that only the file's own tokens tell.
struct BraceEdits {
    std::set<size_t> came, went;
};

/// `was` and `is` are one unit in its file before and now, `edit` lays the clauses of both side by side.
BraceEdits brace_edits(const UnitWords& was, const AlignedText& before, const UnitWords& is, const AlignedText& now,
                       const Alignment& edit);

}  // namespace porttool

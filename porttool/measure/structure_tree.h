// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "metrics/code/tree_distance.h"
#include "porttool/language/dialect.h"
#include "porttool/measure/code_lines.h"

namespace porttool {

/// The blocks and statements of a passage as a tree: below the root one node a unit; below each head (a signature, `if
/// (...)`, `for (...)`) what stands in its braces; leaves are statements. A label stands for the text in the common
/// vocabulary. Braces around a single statement and a unit's own name make no difference.
metrics::Tree structure_tree(const Passage& passage, const Dialect& dialect);

}  // namespace porttool

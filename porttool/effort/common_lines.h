// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/effort/edited_lines.h"
#include "porttool/measure/code_lines.h"

namespace porttool {

/// Lines of files, ascending.
using LineSet = std::vector<uint32_t>;

/// The lines of both sides that lie as a whole in one run of at least 12 common tokens, however the lines are broken.
/// One run must hold it all: where something was deleted, both sides of the seam are common and the line is not.
struct CommonLines {
    LineSet source;  ///< of these only such whose tokens stand, in the port, on a line that the port gained
    LineSet target;
    LineSet half;  ///< of the target, those of which half is common: what `compare` calls shared
};

CommonLines common_lines(const Excerpt& source, const Excerpt& target, const EditedLines& target_edit,
                         const Dialect& dialect);

}  // namespace porttool

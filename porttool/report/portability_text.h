// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/report/portability_json.h"

namespace porttool {

/// For a terminal: the verdict and a table.
std::string portability_table(const WholeReport& whole);
/// For a merge request: the verdict first, then the blocks with their changes, what is open, and where to look. Free of
/// ages and line numbers, so that it changes only with what it says.
std::string portability_markdown(const WholeReport& whole);
/// One row a block; RFC 4180. The columns are in docs/porttool.md; --base adds those that end in _change.
std::string portability_csv(const WholeReport& whole);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/judge/resolve.h"
#include "porttool/judge/verdicts.h"

namespace porttool {

/// Adds a finding for each source unit that no pair leads to, unless it is excused. Returns how many there are, with
/// those that are.
size_t find_unported(const Case& facts, const Resolver& source, FindingList& findings, Verdicts& verdicts);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/difftest/difftest.h"

namespace porttool {

/// What difftest found, for a terminal: pairs that differ first, then those that did not run by their reasons.
std::string difftest_table(const std::vector<DifftestPair>& pairs, bool verbose);

/// The same as JSON.
std::string difftest_json(const std::vector<DifftestPair>& pairs);

/// The pairs, and the prints of the texts that ran: what `check --evidence` reads.
std::string difftest_evidence(const DifftestResult& result);

}  // namespace porttool

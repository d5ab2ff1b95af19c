// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "porttool/difftest/difftest.h"

namespace porttool {

/// What difftest found, for a terminal: pairs that differ first, then those that did not run by their reasons.
std::string difftest_table(const std::vector<DifftestPair>& pairs, bool verbose);

/// The same as JSON.
std::string difftest_json(const std::vector<DifftestPair>& pairs);

/// One input and both results, for a reader and for a program: ` for x = 1: 2, 3`.
std::string counterexample_text(const Counterexample& one);
nlohmann::ordered_json counterexample_json(const Counterexample& one);

/// The pairs, and the prints of the texts that ran: what `check --evidence` reads.
std::string difftest_evidence(const DifftestResult& result);

}  // namespace porttool

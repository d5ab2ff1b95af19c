// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/difftest/trial.h"

namespace porttool {

/// How much a reader has to take in: 0 for 0, 1 for 1, more for numbers of many digits.
int complexity_of(const uint64_t* record, const std::vector<Leaf>& leaves);

/// The simplest record found on which the two sides still differ: numbers go to 0, 1 and others of few digits one after
/// another, each try with all numbers at once in one run.
std::vector<uint64_t> shrunk(Trial& trial, std::vector<uint64_t> record);

}  // namespace porttool

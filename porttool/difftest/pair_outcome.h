// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "porttool/difftest/difftest.h"
#include "porttool/difftest/trial.h"

namespace porttool {

/// Says what became of a pair whose trial ran on a table: its state, on how many inputs both sides gave an answer, and
/// the simplest input on which they part, shrunk. Returns on how many inputs the two differ.
size_t tell_outcome(DifftestPair& pair, Trial& trial, const InputTable& table, int ulps);

}  // namespace porttool

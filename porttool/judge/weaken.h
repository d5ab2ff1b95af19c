// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "porttool/judge/finding_list.h"
#include "porttool/judge/judgement.h"

namespace porttool {

inline constexpr size_t kNoSlip = 12;  ///< words of an edit that nobody makes by mistake

/// Says of an edit why it most likely needs no port: its finding has no higher level than that.
void weaken(const JudgedPair& pair, Finding& finding, Level level, const std::string& why);

/// What the other side most likely does not owe, though nothing proves it: a warning, told once for all such edits.
void doubt(const JudgedPair& pair, Finding& finding, const std::string& why);

}  // namespace porttool

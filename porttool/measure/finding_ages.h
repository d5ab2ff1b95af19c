// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "porttool/judge/check_project.h"
#include "porttool/measure/ledger.h"

namespace porttool {

/// How long each finding on a changed or new unit has stood: the days since the commit, along first parents from HEAD,
/// that brought in what it is about; 0 for what is not committed yet. By fingerprint. Without a git repository, and for
/// findings on what is gone or was never recorded, there is no age.
std::map<std::string, Age> finding_ages(const CheckedProject& checked, const std::string& today);

}  // namespace porttool

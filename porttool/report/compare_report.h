// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/measure/measure.h"

namespace porttool {

/// What `porttool compare` prints.
struct CompareReport {
    std::string a_id, b_id;
    std::string a_file, b_file;
    metrics::WinnowingParameters parameters;
    Similarity similarity;
};

std::string compare_json(const CompareReport& report);
std::string compare_table(const CompareReport& report);

}  // namespace porttool

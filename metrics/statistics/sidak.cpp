// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/statistics/sidak.h"

#include <cmath>

namespace metrics {

double sidak_level(double alpha, size_t tests) {
    return -std::expm1(std::log1p(-alpha) / static_cast<double>(tests == 0 ? 1 : tests));
}

double sidak_p_value(double smallest, size_t tests) {
    return smallest >= 1 ? 1 : -std::expm1(static_cast<double>(tests) * std::log1p(-smallest));
}

}  // namespace metrics

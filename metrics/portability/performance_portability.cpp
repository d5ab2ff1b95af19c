// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/portability/performance_portability.h"

namespace metrics {

double performance_portability(std::span<const std::optional<double>> efficiencies) {
    double sum = 0;
    for (const std::optional<double>& efficiency : efficiencies) {
        if (!efficiency || *efficiency <= 0) return 0;
        sum += 1 / *efficiency;
    }
    return static_cast<double>(efficiencies.size()) / sum;
}

}  // namespace metrics

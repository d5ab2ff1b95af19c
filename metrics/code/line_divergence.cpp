// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/code/line_divergence.h"

#include <algorithm>
#include <iterator>

namespace metrics {

double line_divergence(std::vector<uint64_t> a, std::vector<uint64_t> b) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    std::vector<uint64_t> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    const auto common = static_cast<double>(both.size());
    return 1.0 - common / (static_cast<double>(a.size() + b.size()) - common);
}

}  // namespace metrics

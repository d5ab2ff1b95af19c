// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/port_cost.h"

#include <algorithm>

namespace porttool {

metrics::SharedLines shared_lines(const SideMeasure& port) {
    const double lines = port.lines, shared = port.shared_lines;
    const auto worth = [&](const std::optional<double>& percent) { return percent ? lines * *percent / 100 : shared; };
    const double raw = worth(port.moss_percent_raw), kept = worth(port.moss_percent),
                 blind = worth(port.moss_percent_blind);
    return {lines, shared, std::min({shared, raw, kept, blind}), std::max({shared, raw, kept, blind})};
}

std::optional<metrics::Figure> degree_of_portability(const SideMeasure& port, const metrics::LineWeights& weights) {
    return metrics::degree_from_lines(shared_lines(port), weights);
}

}  // namespace porttool

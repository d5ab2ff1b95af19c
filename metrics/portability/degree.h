// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "metrics/portability/figure.h"

namespace metrics {

/// What redevelopment costs, by component (Mooney 1993), in lines or in hours.
struct RedevelopmentCost {
    double design = 0, coding = 0, testing = 0, documentation = 0;  ///< testing includes debugging
    double total() const { return design + coding + testing + documentation; }
};

/// What a port costs: it takes over the design.
struct PortCost {
    double coding = 0, testing = 0, documentation = 0;
    double total() const { return coding + testing + documentation; }
};

/// Mooney's degree of portability: DP = 1 - C_port / C_redevelop (J. D. Mooney, "Issues in the Specification and
/// Measurement of Software Portability", West Virginia University, TR 93-6). At most 1; negative where the port is the
/// dearer of the two. None where redevelopment costs nothing or a cost is negative or no number.
std::optional<double> degree_of_portability(double port, double redevelopment);

/// The lines of a port and how many of them it shares with its source, under the reading that counts, and under the
/// strictest and the loosest reading of what is shared.
struct SharedLines {
    double lines = 0;
    double shared = 0;
    double shared_low = 0;
    double shared_high = 0;
};

/// What each component costs for a line: by default the code is the only cost. With `retest` the lines that the port
/// shares are tested again at that share of the cost of new ones.
struct LineWeights {
    double design = 0, coding = 1, testing = 0, documentation = 0;
    double retest = 0;
};

RedevelopmentCost redevelopment_from_lines(double lines, const LineWeights& weights = {});
PortCost port_from_lines(double lines, double shared, const LineWeights& weights = {});

/// DP in lines: what the port shares costs nothing, what is novel costs its lines; redevelopment costs all lines of the
/// port. With the default weights DP = 1 - (lines not shared) / (lines). The interval is that of the readings. None
/// without lines.
std::optional<Figure> degree_from_lines(const SharedLines& port, const LineWeights& weights = {});

/// A port whose hours are known.
struct RecordedCost {
    PortCost port;
    RedevelopmentCost redevelopment;
    double uncertainty = 0;  ///< share (0 to 1) by which each of both sums may be off
};

/// DP in hours over a ledger: 1 - (hours of all ports) / (hours of all redevelopments). The interval spans the records'
/// own degrees, each with its uncertainty. None without records, or where redevelopment cost nothing.
std::optional<Figure> degree_from_hours(std::span<const RecordedCost> ledger);

}  // namespace metrics

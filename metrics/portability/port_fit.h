// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "metrics/portability/figure.h"
#include "metrics/portability/least_squares.h"

namespace metrics {

/// A port of which the work and the hours are known. The two impediments are text that has no counterpart in the
/// source, and text that is carried over.
struct RecordedPort {
    double novel = 0;    ///< lines
    double carried = 0;  ///< lines
    double hours = 0;
};

inline constexpr size_t kFewestPorts = 8;

/// The hours of a port as a linear function of its lines, hours = b0 + b1 novel + b2 carried, with coefficients from
/// the project's own records: a model of ours, beside that of Hakuta and Ohminami (power_law.h).
struct PortFit {
    std::optional<LinearFit> fit;
    size_t ports = 0;
    std::string refusal;  ///< why there is no fit: fewer than eight ports, or ports too alike
};
PortFit fit_ports(std::span<const RecordedPort> ports);

/// The hours that a port of that size takes, with the 95 % prediction interval cut at 0. Needs a fit.
Figure predicted_hours(const PortFit& ports, double novel, double carried);

/// DP from predicted hours of a port and the hours that redevelopment takes. The interval is that of the prediction.
std::optional<Figure> degree_from_prediction(const Figure& port_hours, double redevelopment_hours);

}  // namespace metrics

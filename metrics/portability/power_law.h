// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "metrics/portability/figure.h"
#include "metrics/portability/impediments.h"
#include "metrics/portability/least_squares.h"

namespace metrics {

/// A port of which size, impediments and hours are known.
struct SizedPort {
    double lines = 0;
    Impediments impediments;
    double hours = 0;
    bool mined = false;  ///< from the public history of another project
};

/// Hakuta and Ohminami's own form ("A study of software portability evaluation", Journal of Systems and Software 38,
/// 1997): Y = C 10^(b_p alpha_p) 10^(b_H alpha_H) 10^(b_E alpha_E) X^b, hours Y of X lines, with coefficients from
/// these ports and none of theirs. Least squares of log10 Y, linear in the logarithms.
struct PowerLaw {
    std::optional<LinearFit> fit;
    std::array<bool, 3> told{};  ///< which impediments differ among the ports; the others are part of C
    size_t ports = 0;
    size_t mined = 0;
    std::string refusal;  ///< why there is no fit: fewer than eight ports, or ports too alike
};

/// Ports without lines or hours have no logarithm and are left out.
PowerLaw fit_power_law(std::span<const SizedPort> ports);

/// The hours that a port takes, with the 95 % prediction interval, which is one of factors. Needs a fit and lines above
/// 0.
Figure predicted_hours(const PowerLaw& law, double lines, const Impediments& impediments);

}  // namespace metrics

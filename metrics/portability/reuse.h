// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "metrics/portability/degree.h"

namespace metrics {

/// The parameters of COCOMO II's reuse model (Boehm et al., "Software Cost Estimation with COCOMO II", 2000, section
/// 2.2), in percent but for `unfamiliarity`.
struct ReuseParameters {
    double design_modified = 0;  ///< DM
    double code_modified = 0;    ///< CM
    double integration = 0;      ///< IM
    double assessment = 0;       ///< AA: 0, 2, 4, 6 or 8
    double understanding = 0;    ///< SU: 10 (very high cohesion and clarity) to 50 (very low)
    double unfamiliarity = 0;    ///< UNFM: 0 to 1
    double translated = 0;       ///< AT: re-engineered by a program
};

/// AAF = 0.4 DM + 0.3 CM + 0.3 IM, in percent.
double adaptation_adjustment_factor(const ReuseParameters& parameters);

/// AAM = (AA + AAF (1 + 0.02 SU UNFM)) / 100 for AAF <= 50, else (AA + AAF + SU UNFM) / 100: the cost of an adapted
/// line in new lines. Above 1 adaptation is dearer than writing anew.
double adaptation_adjustment_modifier(const ReuseParameters& parameters);

/// ESLOC = ASLOC (1 - AT / 100) AAM.
double equivalent_lines(double adapted_lines, const ReuseParameters& parameters);

/// What a project has settled of the parameters; what it has not is open, and becomes the interval.
struct ReuseSettings {
    std::optional<double> design_modified, integration, assessment, understanding, unfamiliarity, translated;
};

/// DP with the port's cost in equivalent lines: DP = 1 - ESLOC / lines, CM being the share that is not shared. Where a
/// parameter is not settled: DM 0 (a port takes over the design), IM as CM, AA 4 (0 to 8), SU 30 (10 to 50), UNFM 0.4
/// (0 to 1), AT 0. The interval goes from the worst to the best of the open ones and of the readings of what is shared.
std::optional<Figure> degree_from_reuse(const SharedLines& port, const ReuseSettings& settings = {});

}  // namespace metrics

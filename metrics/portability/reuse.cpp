// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/portability/reuse.h"

namespace metrics {
namespace {

constexpr double kPercent = 100;

/// Values for the parameters that a project has left open.
struct Open {
    double assessment, understanding, unfamiliarity;
};
constexpr Open kNominal = {4, 30, 0.4};
constexpr Open kBest = {0, 10, 0};
constexpr Open kWorst = {8, 50, 1};

ReuseParameters parameters_for(double lines, double shared, const ReuseSettings& settings, const Open& open) {
    const double modified = kPercent * (lines - shared) / lines;
    return {settings.design_modified.value_or(0),
            modified,
            settings.integration.value_or(modified),
            settings.assessment.value_or(open.assessment),
            settings.understanding.value_or(open.understanding),
            settings.unfamiliarity.value_or(open.unfamiliarity),
            settings.translated.value_or(0)};
}

}  // namespace

double adaptation_adjustment_factor(const ReuseParameters& parameters) {
    return 0.4 * parameters.design_modified + 0.3 * parameters.code_modified + 0.3 * parameters.integration;
}

double adaptation_adjustment_modifier(const ReuseParameters& parameters) {
    const double factor = adaptation_adjustment_factor(parameters);
    const double strangeness = parameters.understanding * parameters.unfamiliarity;
    constexpr double kBreak = 50;
    const double percent = factor <= kBreak ? parameters.assessment + factor * (1 + 0.02 * strangeness)
                                            : parameters.assessment + factor + strangeness;
    return percent / kPercent;
}

double equivalent_lines(double adapted_lines, const ReuseParameters& parameters) {
    return adapted_lines * (1 - parameters.translated / kPercent) * adaptation_adjustment_modifier(parameters);
}

std::optional<Figure> degree_from_reuse(const SharedLines& port, const ReuseSettings& settings) {
    if (!(port.lines > 0)) return std::nullopt;
    const auto degree = [&](double shared, const Open& open) {
        return degree_of_portability(equivalent_lines(port.lines, parameters_for(port.lines, shared, settings, open)),
                                     port.lines);
    };
    const auto value = degree(port.shared, kNominal), low = degree(port.shared_low, kWorst),
               high = degree(port.shared_high, kBest);
    if (!value || !low || !high) return std::nullopt;
    const ReuseParameters used = parameters_for(port.lines, port.shared, settings, kNominal);
    return Figure{*value,
                  *low,
                  *high,
                  "COCOMO II reuse",
                  {{"lines of the port", port.lines, "lines"},
                   {"equivalent new lines", equivalent_lines(port.lines, used), "lines"},
                   {"DM", used.design_modified, "percent"},
                   {"CM", used.code_modified, "percent"},
                   {"IM", used.integration, "percent"},
                   {"AA", used.assessment, "percent"},
                   {"SU", used.understanding, "percent"},
                   {"UNFM", used.unfamiliarity, ""},
                   {"AT", used.translated, "percent"}}};
}

}  // namespace metrics

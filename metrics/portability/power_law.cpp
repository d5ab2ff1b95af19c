// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/portability/power_law.h"

#include <cmath>
#include <vector>

#include "metrics/portability/port_fit.h"

namespace metrics {
namespace {

constexpr std::array<const char*, 3> kImpediments = {"p", "H", "E"};

std::vector<double> predictors(const std::array<bool, 3>& told, double lines, const Impediments& impediments) {
    std::vector<double> row = {1, std::log10(lines)};
    for (size_t i = 0; i < told.size(); ++i)
        if (told[i]) row.push_back(impediments.all()[i]);
    return row;
}

void add_coefficient(const std::string& name, const LinearFit& fit, size_t column, Figure& figure) {
    figure.inputs.push_back({name, fit.coefficients[column], ""});
    figure.inputs.push_back({"standard error of " + name, standard_error(fit, column), ""});
}

}  // namespace

PowerLaw fit_power_law(std::span<const SizedPort> ports) {
    std::vector<SizedPort> known;
    PowerLaw out;
    for (const SizedPort& port : ports) {
        if (!(port.lines > 0 && port.hours > 0)) continue;
        known.push_back(port);
        out.mined += port.mined ? 1 : 0;
        for (size_t i = 0; i < out.told.size(); ++i)
            out.told[i] = out.told[i] || port.impediments.all()[i] != known.front().impediments.all()[i];
    }
    out.ports = known.size();
    if (out.ports < kFewestPorts) {
        out.refusal = std::to_string(out.ports) + " ports with lines and hours are recorded; a fit needs at least " +
                      std::to_string(kFewestPorts);
        return out;
    }
    std::vector<std::vector<double>> rows;
    std::vector<double> hours;
    for (const SizedPort& port : known) {
        rows.push_back(predictors(out.told, port.lines, port.impediments));
        hours.push_back(std::log10(port.hours));
    }
    out.fit = fit_least_squares(rows, hours);
    if (!out.fit) out.refusal = "the recorded ports are too alike to tell lines and impediments apart";
    return out;
}

Figure predicted_hours(const PowerLaw& law, double lines, const Impediments& impediments) {
    const LinearFit& fit = *law.fit;
    const Prediction exponent = predict(fit, predictors(law.told, lines, impediments));
    Figure figure{std::pow(10, exponent.value),
                  std::pow(10, exponent.low),
                  std::pow(10, exponent.high),
                  "Hakuta and Ohminami, equation 8, fitted",
                  {{"lines", lines, "lines"},
                   {"ports recorded", static_cast<double>(law.ports), ""},
                   {"of them mined", static_cast<double>(law.mined), ""},
                   {"C", std::pow(10, fit.coefficients[0]), "hours"},
                   {"standard error of C (factor)", std::pow(10, standard_error(fit, 0)), ""},
                   {"scatter (factor)", std::pow(10, fit.residual_deviation), ""}}};
    add_coefficient("beta", fit, 1, figure);
    size_t column = 2;
    for (size_t i = 0; i < law.told.size(); ++i) {
        const std::string name = kImpediments[i];
        figure.inputs.push_back({"alpha_" + name, impediments.all()[i], ""});
        if (law.told[i]) add_coefficient("beta_" + name, fit, column++, figure);
    }
    return figure;
}

}  // namespace metrics

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/portability/degree.h"

#include <algorithm>
#include <cmath>

namespace metrics {

std::optional<double> degree_of_portability(double port, double redevelopment) {
    if (!std::isfinite(port) || !std::isfinite(redevelopment) || port < 0 || redevelopment <= 0) return std::nullopt;
    return 1 - port / redevelopment;
}

RedevelopmentCost redevelopment_from_lines(double lines, const LineWeights& weights) {
    return {weights.design * lines, weights.coding * lines, weights.testing * lines, weights.documentation * lines};
}

PortCost port_from_lines(double lines, double shared, const LineWeights& weights) {
    const double novel = lines - shared;
    return {weights.coding * novel, weights.testing * (novel + weights.retest * shared), weights.documentation * novel};
}

std::optional<Figure> degree_from_lines(const SharedLines& port, const LineWeights& weights) {
    const double redevelopment = redevelopment_from_lines(port.lines, weights).total();
    const auto degree = [&](double shared) {
        return degree_of_portability(port_from_lines(port.lines, shared, weights).total(), redevelopment);
    };
    const auto value = degree(port.shared), one = degree(port.shared_low), other = degree(port.shared_high);
    if (!value || !one || !other) return std::nullopt;
    const auto [low, high] = std::minmax({*value, *one, *other});
    return Figure{
        *value, low, high, "lines", {{"lines of the port", port.lines, "lines"}, {"shared", port.shared, "lines"}}};
}

std::optional<Figure> degree_from_hours(std::span<const RecordedCost> ledger) {
    double port = 0, redevelopment = 0;
    Figure figure;
    bool first = true;
    for (const RecordedCost& record : ledger) {
        const double least = 1 - record.uncertainty, most = 1 + record.uncertainty;
        const double spent = record.port.total(), saved = record.redevelopment.total();
        const auto low = degree_of_portability(spent * most, saved * least),
                   high = degree_of_portability(spent * least, saved * most);
        if (!low || !high) return std::nullopt;
        figure.low = first ? *low : std::min(figure.low, *low);
        figure.high = first ? *high : std::max(figure.high, *high);
        first = false;
        port += spent;
        redevelopment += saved;
    }
    const auto value = degree_of_portability(port, redevelopment);
    if (!value) return std::nullopt;
    figure.value = *value;
    figure.model = "hours";
    figure.inputs = {{"port", port, "hours"},
                     {"redevelopment", redevelopment, "hours"},
                     {"records", static_cast<double>(ledger.size()), ""}};
    return figure;
}

}  // namespace metrics

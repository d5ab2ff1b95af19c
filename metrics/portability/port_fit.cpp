// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/portability/port_fit.h"

#include <algorithm>

#include "metrics/portability/degree.h"

namespace metrics {

PortFit fit_ports(std::span<const RecordedPort> ports) {
    PortFit out;
    out.ports = ports.size();
    if (ports.size() < kFewestPorts) {
        out.refusal = std::to_string(ports.size()) + " ports with hours are recorded; a fit needs at least " +
                      std::to_string(kFewestPorts);
        return out;
    }
    std::vector<std::vector<double>> rows;
    std::vector<double> hours;
    for (const RecordedPort& port : ports) {
        rows.push_back({1, port.novel, port.carried});
        hours.push_back(port.hours);
    }
    out.fit = fit_least_squares(rows, hours);
    if (!out.fit) out.refusal = "the recorded ports are too alike to tell novel from carried lines";
    return out;
}

Figure predicted_hours(const PortFit& ports, double novel, double carried) {
    const Prediction hours = predict(*ports.fit, {1, novel, carried});
    const std::vector<double>& b = ports.fit->coefficients;
    return {std::max(0.0, hours.value),
            std::max(0.0, hours.low),
            std::max(0.0, hours.high),
            "linear in novel and carried lines, fitted",
            {{"novel", novel, "lines"},
             {"carried over", carried, "lines"},
             {"ports recorded", static_cast<double>(ports.ports), ""},
             {"hours at least", b[0], "hours"},
             {"hours for a novel line", b[1], "hours"},
             {"hours for a carried line", b[2], "hours"}}};
}

std::optional<Figure> degree_from_prediction(const Figure& port_hours, double redevelopment_hours) {
    const auto value = degree_of_portability(port_hours.value, redevelopment_hours),
               low = degree_of_portability(port_hours.high, redevelopment_hours),
               high = degree_of_portability(port_hours.low, redevelopment_hours);
    if (!value || !low || !high) return std::nullopt;
    Figure figure{*value, *low, *high, port_hours.model, port_hours.inputs};
    figure.inputs.push_back({"port", port_hours.value, "hours"});
    figure.inputs.push_back({"redevelopment", redevelopment_hours, "hours"});
    return figure;
}

}  // namespace metrics

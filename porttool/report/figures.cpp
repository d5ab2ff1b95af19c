// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

namespace porttool {

nlohmann::ordered_json number_json(const std::optional<double>& number) {
    if (!number || !std::isfinite(*number)) return nullptr;
    constexpr double kDecimals = 1e6;
    return std::round(*number * kDecimals) / kDecimals;
}

nlohmann::ordered_json figure_json(const std::optional<metrics::Figure>& figure) {
    if (!figure) return nullptr;
    nlohmann::ordered_json inputs = nlohmann::ordered_json::object();
    for (const metrics::FigureInput& input : figure->inputs) inputs[input.name] = number_json(input.value);
    return {{figure->model == "lines" ? "loc" : "value", number_json(figure->value)},
            {"low", number_json(figure->low)},
            {"high", number_json(figure->high)},
            {"model", figure->model},
            {"inputs", inputs}};
}

nlohmann::ordered_json place_json(const std::optional<Place>& place) {
    if (!place) return nullptr;
    return {{"id", place->id}, {"file", place->file}, {"line", place->line}, {"end_line", place->end_line}};
}

nlohmann::ordered_json summary_json(const Summary& s) {
    return {{"pairs", s.pairs},       {"in_step", s.in_step},
            {"drifted", s.drifted},   {"review", s.review},
            {"unported", s.unported}, {"deferred", s.deferred},
            {"ignored", s.ignored},   {"units", s.units},
            {"unpaired", s.unpaired}, {"unpaired_changed", s.unpaired_changed},
            {"recorded", s.recorded}, {"verified", s.verified}};
}

std::string bounded_text(double value, double most, int digits) {
    const double step = std::pow(10, -digits);
    return fmt::format("{:.{}f}", value > 0 && value < most ? std::clamp(value, step, most - step) : value, digits);
}

std::string figure_text(const std::optional<metrics::Figure>& figure) {
    if (!figure) return "-";
    const auto text = [](double value) { return value > 0 ? bounded_text(value, 1, 2) : fmt::format("{:.2f}", value); };
    return text(figure->value) + " (" + text(figure->low) + " to " + text(figure->high) + ")";
}

std::string short_id(const std::string& commit) {
    constexpr size_t kDigits = 10;
    return commit.substr(0, kDigits);
}

}  // namespace porttool

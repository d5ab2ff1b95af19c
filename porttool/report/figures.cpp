// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/figures.h"

#include <fmt/format.h>

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

std::string figure_text(const std::optional<metrics::Figure>& figure) {
    if (!figure) return "-";
    return fmt::format("{:.2f} ({:.2f} to {:.2f})", figure->value, figure->low, figure->high);
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

std::string day_of(int64_t time) {
    const auto seconds = static_cast<std::time_t>(time);
    std::tm date{};
    if (gmtime_r(&seconds, &date) == nullptr) return "-";
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d", &date);
    return text.data();
}

}  // namespace porttool

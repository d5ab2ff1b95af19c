// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "porttool/text/utf8.h"

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

std::string bounded_text(double value, double most, int digits) {
    const double step = std::pow(10, -digits);
    return fmt::format("{:.{}f}", value > 0 && value < most ? std::clamp(value, step, most - step) : value, digits);
}

std::string figure_text(const std::optional<metrics::Figure>& figure) {
    if (!figure) return "-";
    const auto text = [](double value) { return value > 0 ? bounded_text(value, 1, 2) : fmt::format("{:.2f}", value); };
    return text(figure->value) + " (" + text(figure->low) + " to " + text(figure->high) + ")";
}

std::string plain_text(const std::string& text) {
    constexpr char kDelete = 0x7f;
    std::string out = as_utf8(text);
    std::replace_if(
        out.begin(), out.end(), [](char c) { return (c >= 0 && c < ' ') || c == kDelete; }, ' ');
    return out;
}

/// What a spreadsheet would take for a formula gets an apostrophe before it.
static std::string csv_safe(const std::string& text) {
    return !text.empty() && std::string("=+-@\t\r").find(text[0]) != std::string::npos ? "'" + text : text;
}

std::string csv_field(const std::string& text) {
    const std::string safe = csv_safe(text);
    if (safe.find_first_of(",\"\r\n") == std::string::npos) return safe;
    std::string out = "\"";
    for (const char c : safe) out += c == '"' ? std::string("\"\"") : std::string(1, c);
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

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "porttool/text/sink/html.h"

namespace porttool {
namespace {

constexpr double kWidth = 960, kHeight = 300, kLeft = 76, kRight = 16, kTop = 14, kBottom = 34;

/// A number short enough for an axis, without an exponent.
std::string number_text(double value) {
    constexpr double kThousand = 1000;
    return std::abs(value) >= kThousand ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

/// Places of the points from left to right: by time, or by number where all have one time.
std::vector<double> places(const std::vector<int64_t>& times) {
    std::vector<double> out;
    const auto first = static_cast<double>(times.front());
    double span = 0;
    for (const int64_t time : times) span = std::max(span, static_cast<double>(time) - first);
    for (size_t i = 0; i < times.size(); ++i) {
        const double part = span > 0
                                ? (static_cast<double>(times[i]) - first) / span
                                : static_cast<double>(i) / static_cast<double>(std::max<size_t>(1, times.size() - 1));
        out.push_back(kLeft + std::clamp(part, 0.0, 1.0) * (kWidth - kLeft - kRight));
    }
    return out;
}

double height_of(const Chart& chart, double value) {
    const double part = (value - chart.low) / (chart.high - chart.low);
    return kHeight - kBottom - std::clamp(part, 0.0, 1.0) * (kHeight - kTop - kBottom);
}

std::string path_of(const Chart& chart, const Series& series, const std::vector<double>& x) {
    std::string path;
    bool drawing = false;
    for (size_t i = 0; i < series.values.size(); ++i) {
        if (!series.values[i]) {
            drawing = false;
            continue;
        }
        const auto go_to = [&](double value) {
            path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", x[i], height_of(chart, value));
            drawing = true;
        };
        if (!series.before.empty() && series.before[i] != *series.values[i]) go_to(series.before[i]);
        go_to(*series.values[i]);
    }
    return path;
}

std::string grid_of(const Chart& chart, const TimeAxis& axis) {
    std::string out;
    constexpr int kSteps = 4;
    for (int i = 0; i <= kSteps; ++i) {
        const double value = chart.low + (chart.high - chart.low) * i / kSteps, y = height_of(chart, value);
        out += fmt::format(
            "<line class=\"grid\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/><text x=\"{}\" "
            "y=\"{:.1f}\" text-anchor=\"end\">{}</text>",
            kLeft, kWidth - kRight, y, y, kLeft - 8, y + 4, number_text(value));
    }
    out += fmt::format("<text x=\"{}\" y=\"{}\">{}</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>", kLeft,
                       kHeight - 10, axis.first_label, kWidth - kRight, kHeight - 10, axis.last_label);
    return out;
}

}  // namespace

std::string figure_of(const Chart& chart, const TimeAxis& axis) {
    const std::vector<double> x = places(axis.times);
    std::string out = fmt::format(
        "<h2>{}</h2>\n<p class=\"fine\">{}</p>\n<figure><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">"
        "<title>{}</title><desc>{}</desc>{}\n",
        html_text(chart.title), html_text(chart.description), kWidth, kHeight, html_text(chart.title),
        html_text(chart.title), html_text(chart.description), grid_of(chart, axis));
    std::string legend, above;
    for (const Series& series : chart.series) {
        const std::string path = path_of(chart, series, x);
        if (chart.filled && !path.empty())
            out += fmt::format("<path d=\"{}L{:.1f} {:.1f}L{:.1f} {:.1f}Z\" fill=\"var({})\" opacity=\".18\"/>", path,
                               x.back(), height_of(chart, chart.low), x.front(), height_of(chart, chart.low),
                               series.color);
        // The first lies above the others: where they are one line, its dashes show.
        std::string& layer = &series == &chart.series.front() ? above : out;
        layer += fmt::format("<path class=\"series\" d=\"{}\" stroke=\"var({})\" stroke-dasharray=\"{}\"/>", path,
                             series.color, series.dash);
        if (!series.values.empty() && series.values.back())
            out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"var({})\"/>\n", x.back(),
                               height_of(chart, *series.values.back()), series.color);
        legend += fmt::format(
            "<li><svg viewBox=\"0 0 28 10\" aria-hidden=\"true\"><path class=\"series\" d=\"M0 5H28\" "
            "stroke=\"var({})\" stroke-dasharray=\"{}\"/></svg>{}{}</li>",
            series.color, series.dash, html_text(series.name),
            series.values.empty() || !series.values.back() ? std::string()
                                                           : ": " + number_text(*series.values.back()) + chart.unit);
    }
    return out + above + "</svg><ul class=\"legend\">" + legend + "</ul></figure>\n";
}

}  // namespace porttool

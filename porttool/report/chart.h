// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace porttool {

/// A line of a chart. `color` names a variable of the page's style, `dash` is SVG's.
struct Series {
    std::string name, color, dash;
    std::vector<std::optional<double>> values;  ///< one a point
    std::vector<double> before;                 ///< values an instant earlier, where they jump; else empty
};

struct Chart {
    std::string title, description;
    double low = 0, high = 1;
    std::string unit;
    std::vector<Series> series;
    bool filled = false;
};

/// What the points of all series stand over: seconds since 1970, ascending, one a point, and what is written at both
/// ends.
struct TimeAxis {
    std::vector<int64_t> times;
    std::string first_label, last_label;
};

/// A chart with heading, legend and description, as plain SVG in HTML.
std::string figure_of(const Chart& chart, const TimeAxis& axis);

}  // namespace porttool

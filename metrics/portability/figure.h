// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace metrics {

/// What a figure was computed from.
struct FigureInput {
    std::string name;
    double value = 0;
    std::string unit;  ///< "lines", "hours", "percent"; empty for a plain number
};

/// A figure that can be defended: never without its interval, its model and what went in.
struct Figure {
    double value = 0;
    double low = 0;   ///< low <= value <= high
    double high = 0;  ///< what the interval spans is said where the model is made
    std::string model;
    std::vector<FigureInput> inputs;
};

}  // namespace metrics

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "metrics/portability/figure.h"
#include "porttool/judge/judgement.h"

namespace porttool {

/// `{"value", "low", "high", "model", "inputs": {name: value}}`; a figure in lines goes by "loc" in place of "value".
nlohmann::ordered_json figure_json(const std::optional<metrics::Figure>& figure);

/// A number as JSON, or null; rounded to six decimals so that files stay the same from machine to machine.
nlohmann::ordered_json number_json(const std::optional<double>& number);

/// `{"id", "file", "line", "end_line"}`, or null.
nlohmann::ordered_json place_json(const std::optional<Place>& place);

/// The counts of a judgement.
nlohmann::ordered_json summary_json(const Summary& summary);

/// A figure from 0 to `most`, rounded, but `most` and 0 only where it is exactly that.
std::string bounded_text(double value, double most, int digits);

/// The start of a commit's id, as long as people quote it.
std::string short_id(const std::string& commit);

/// "0.73 (0.60 to 0.81)", or "-".
std::string figure_text(const std::optional<metrics::Figure>& figure);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Dates as YYYY-MM-DD.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace porttool {

/// True for four, two and two digits, be they a day of the calendar or not.
bool has_form_of_date(const std::string& text);

/// True for a day of the calendar.
bool is_date(const std::string& text);

/// Days from one date to another; none if either is none.
std::optional<int> days_between(const std::string& from, const std::string& to);

/// The date of seconds since 1970; "-" for what has none.
std::string day_of(int64_t time);

}  // namespace porttool

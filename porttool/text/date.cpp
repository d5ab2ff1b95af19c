// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/date.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <string_view>

namespace porttool {
namespace {

std::optional<std::chrono::sys_days> read_date(const std::string& text) {
    int year = 0;
    unsigned month = 0, day = 0;
    if (!has_form_of_date(text) || std::sscanf(text.c_str(), "%4d-%2u-%2u", &year, &month, &day) != 3)
        return std::nullopt;
    const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)};
    return date.ok() ? std::optional(std::chrono::sys_days(date)) : std::nullopt;
}

}  // namespace

bool has_form_of_date(const std::string& text) {
    constexpr std::string_view kForm = "0000-00-00";
    return std::equal(text.begin(), text.end(), kForm.begin(), kForm.end(),
                      [](char c, char form) { return form == '-' ? c == '-' : c >= '0' && c <= '9'; });
}

bool is_date(const std::string& text) { return read_date(text).has_value(); }

std::optional<int> days_between(const std::string& from, const std::string& to) {
    const auto first = read_date(from), last = read_date(to);
    if (!first || !last) return std::nullopt;
    return static_cast<int>((*last - *first).count());
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

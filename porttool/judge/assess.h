// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "porttool/compare/compare_budget.h"
#include "porttool/language/dialect.h"
#include "porttool/normal/unit_state.h"

namespace porttool {

/// What the texts of a pair say to each other today, whatever they said before: the same statement by statement; the
/// same in other words; something else; nothing in common.
enum class Assessment : uint8_t { Twin, Equivalent, Differs, Unlike };
inline constexpr std::array<std::string_view, 4> kAssessmentNames = {"twin", "equivalent", "differs", "unlike"};
constexpr std::string_view assessment_name(Assessment assessment) {
    return kAssessmentNames.at(static_cast<size_t>(assessment));
}

/// Compares two units after translation into one vocabulary, their own names and those of their locals left out. What
/// the budget does not allow to compare differs.
Assessment assess(const UnitState& source, const UnitState& target, const Dialect& dialect, CompareBudget& budget);

/// True where the texts say the same.
constexpr bool says_the_same(Assessment assessment) { return assessment <= Assessment::Equivalent; }

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The words of [rules] in portmap.toml. What a rule means stands in judge/rules.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "porttool/text/enum_names.h"

namespace porttool {

/// How much a finding weighs; one that is off is not shown.
enum class Level : uint8_t { Off, Note, Warning, Error };
inline constexpr std::array<std::string_view, 4> kLevelNames = {"off", "note", "warning", "error"};

constexpr std::string_view level_name(Level level) { return kLevelNames.at(static_cast<size_t>(level)); }
constexpr std::optional<Level> level_named(std::string_view text) { return value_named<Level>(kLevelNames, text); }

/// What a finding is of. A comment in the code may name another: then it settles nothing.
enum class Rule : uint8_t {
    SourceChanged,
    PortDiffers,
    TargetChanged,
    Unported,
    Orphaned,
    DeadLink,
    ConstantDiffers,
    LayoutDiffers,
    DeferralExpired,
    UnusedSuppression,
    Unreadable,
    DialectHazard,
    Qualifiers,
    Unpaired,
    Unrecorded,
    UnexplainedDifference
};
inline constexpr auto kRuleNames = std::to_array<std::string_view>({
    "source-changed",
    "port-differs",
    "target-changed",
    "unported",
    "orphaned",
    "dead-link",
    "constant-differs",
    "layout-differs",
    "deferral-expired",
    "unused-suppression",
    "unreadable",
    "dialect-hazard",
    "qualifiers",
    "unpaired",
    "unrecorded",
    "unexplained-difference",
});

constexpr std::string_view rule_name(Rule rule) { return kRuleNames.at(static_cast<size_t>(rule)); }
constexpr std::optional<Rule> rule_named(std::string_view text) { return value_named<Rule>(kRuleNames, text); }

}  // namespace porttool

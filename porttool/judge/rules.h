// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "porttool/read/map_file.h"
#include "porttool/read/rule.h"

namespace porttool {

/// What a rule stands for.
struct RuleRow {
    Rule rule;
    Level level;               ///< where [rules] says nothing
    std::string_view meaning;  ///< of a finding of it
    /// The first `ID` in it becomes the argument that names the finding: the source's id, SOURCE=TARGET where the
    /// source has several ports, the fingerprint where neither can be pasted. No other word may contain `ID`.
    std::string_view remedy;
};

const RuleRow& rule_row(Rule rule);

/// The level of a rule in a project: what [rules] says, else that of its row as `reference` has it.
Level level_in(Rule rule, const MapFile& map);

/// Meaning and remedy, a line each.
std::string rule_help(Rule rule);

}  // namespace porttool

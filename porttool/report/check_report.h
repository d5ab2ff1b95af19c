// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "porttool/judge/judge.h"

namespace porttool {

std::string check_json(const Judgement& judgement);

/// One finding as it stands in that.
nlohmann::ordered_json finding_json(const Finding& finding);

/// What programs saw of a finding; null where they saw nothing.
nlohmann::ordered_json evidence_json(const Finding& finding);
/// Where a picture of the evidence lies, from where its file was named from.
std::string picture_path(const FindingEvidence& evidence, const std::string& picture);

/// What no pair watches, part of a sentence: "265 of 492 source units are not watched, 14 of them changed here".
std::string unwatched_text(const Summary& summary, Reference reference);

/// What follows in that sentence: that nobody has compared the texts of any pair; "" where somebody has.
std::string verified_text(const Summary& summary);

/// Of a row of what a change does to the gate, so much is shown to people; JSON has it whole.
inline constexpr size_t kLongestBroughtIn = 1000;

/// What is said in place of the rows after the first so many; "" where there are no more.
std::string more_brought_in(const std::vector<BroughtIn>& brought_in, size_t shown);

/// One finding with its remedy: lines.
std::string finding_text(const Finding& finding, bool color);

/// How the project stands: a line.
std::string summary_text(const Judgement& judgement);

/// Findings with their remedies, then one line of summary; `color` adds terminal colours.
std::string check_table(const Judgement& judgement, bool color);

}  // namespace porttool

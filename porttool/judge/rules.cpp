// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/rules.h"

#include <array>

namespace porttool {
namespace {

/// In the order of the enum.
constexpr std::array<RuleRow, kRuleNames.size()> kRules = {{
    {Rule::SourceChanged, Level::Error,
     "The source changed, or what its words stand for did, since both sides were last in step, and its port did not.",
     "Port the change; if it needs no port, run: porttool accept ID --reason TEXT"},
    {Rule::PortDiffers, Level::Error, "Both sides changed, but the two edits are not the same after translation.",
     "Bring the port in line; if it is right as it is, run: porttool accept ID --reason TEXT"},
    {Rule::TargetChanged, Level::Warning, "The port changed, or what its words stand for did, and its source did not.",
     "If the change belongs to the port alone, run: porttool accept ID; else carry it to the source"},
    {Rule::Unported, Level::Error, "A new unit has no counterpart, nor anything on the other side that looks like one.",
     "Port it and run: porttool accept SOURCE=TARGET; or: porttool ignore ID --reason TEXT"},
    {Rule::Orphaned, Level::Warning, "The source unit is gone and its port is still there.",
     "Remove the port and its [[pair]], or name the new source in portmap.toml"},
    {Rule::DeadLink, Level::Error, "The map names a unit that never was, or whose port is gone.",
     "Correct or remove the [[pair]] in portmap.toml"},
    {Rule::ConstantDiffers, Level::Error, "A paired constant changed and the two sides now have different values.",
     "Give both the same value, or run: porttool accept ID --reason TEXT"},
    {Rule::LayoutDiffers, Level::Error, "A paired struct changed and the two sides now have different fields.",
     "Give both the same fields in the same order, or run: porttool accept ID --reason TEXT"},
    {Rule::DeferralExpired, Level::Error, "A deferred finding is past its date.",
     "Port the change now, or defer it anew with an owner and a reason"},
    {Rule::UnusedSuppression, Level::Warning, "A suppression settles nothing any more.", "Remove it"},
    {Rule::Unreadable, Level::Warning, "A file of the map could not be read.",
     "Make it readable, or take it out of [sides]"},
    {Rule::DialectHazard, Level::Note, "A built-in means different things on the two sides.",
     "Guard the argument on both sides"},
    {Rule::Qualifiers, Level::Off,
     "One side was edited in a way that changes no value: qualifiers, hints to the compiler, another spelling.",
     "Edit the other side likewise, or run: porttool accept ID"},
    {Rule::Unpaired, Level::Warning, "A new unit is in no pair, and one of the other side looks like its counterpart.",
     "Pair the two with the accept that the finding names; if they are none, run: porttool ignore ID --reason TEXT"},
    {Rule::Unrecorded, Level::Error, "A pair of the map was never recorded as in step, so no change of it is seen.",
     "Compare the two once, then run: porttool accept ID"},
    {Rule::UnexplainedDifference, Level::Error, "Both sides ran, what they give differs, and no finding says why.",
     "Find what differs and bring it in line; where it may differ, say so above it in the code: "
     "porttool: ignore(unexplained-difference) REASON"},
}};

constexpr bool has_a_row_each() {
    for (size_t i = 0; i < kRules.size(); ++i)
        if (kRules[i].rule != static_cast<Rule>(i) || kRules[i].remedy.empty()) return false;
    return true;
}
static_assert(has_a_row_each(), "a row for each rule, in the order of the enum");

}  // namespace

const RuleRow& rule_row(Rule rule) { return kRules.at(static_cast<size_t>(rule)); }

Level level_in(Rule rule, const MapFile& map) {
    if (const auto level = map.rules.find(rule); level != map.rules.end()) return level->second;
    const bool swaps = rule == Rule::SourceChanged || rule == Rule::TargetChanged;
    if (swaps && map.reference == Reference::Target)
        rule = rule == Rule::SourceChanged ? Rule::TargetChanged : Rule::SourceChanged;
    const bool loses = rule == Rule::TargetChanged || rule == Rule::Orphaned;
    if (loses && map.reference == Reference::Both) return Level::Error;
    return rule_row(rule).level;
}

std::string rule_help(Rule rule) {
    const RuleRow& row = rule_row(rule);
    return std::string(row.meaning) + "\n" + std::string(row.remedy);
}

}  // namespace porttool

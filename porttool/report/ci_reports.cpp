// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/ci_reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "porttool/judge/rules.h"
#include "porttool/report/check_report.h"
#include "porttool/text/shortened.h"
#include "porttool/text/sink/json_rows.h"
#include "porttool/text/sink/markdown.h"
#include "porttool/text/sink/sarif.h"
#include "porttool/text/sink/workflow_command.h"
#include "porttool/text/sink/xml.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;

/// A place by its path from the root of the repository. The other checkout of a target may lead out of it.
Place below(const std::string& folder, Place place) {
    if (!folder.empty()) place.file = std::filesystem::path(folder + place.file).lexically_normal().generic_string();
    return place;
}

/// Where a finding is shown: the changed source, else the target, else the map.
Place shown_at(const Finding& f, const std::string& folder = "") {
    if (f.source) return below(folder, *f.source);
    return below(folder, f.target.value_or(Place{f.map_source, "portmap.toml", f.map_line, f.map_line}));
}

ordered_json sarif_location(const Place& place) {
    return {{"physicalLocation",
             {{"artifactLocation", {{"uri", uri_path(place.file)}, {"uriBaseId", "%SRCROOT%"}}},
              {"region",
               {{"startLine", std::max(1u, place.line)}, {"endLine", std::max({1u, place.line, place.end_line})}}}}},
            {"logicalLocations", ordered_json::array({{{"fullyQualifiedName", place.id}}})}};
}

ordered_json sarif_rule(Rule rule) {
    const RuleRow& row = rule_row(rule);
    return {
        {"id", rule_name(rule)},
        {"name", rule_name(rule)},
        {"shortDescription", {{"text", row.meaning}}},
        {"help", {{"text", rule_help(rule)}, {"markdown", fmt::format("{}\n\n{}", row.meaning, row.remedy)}}},
        {"defaultConfiguration",
         {{"level", row.level == Level::Off ? "none" : level_name(row.level)}, {"enabled", row.level != Level::Off}}}};
}

}  // namespace

namespace {

/// A finding as a result (3.27); null for one whose rule is off.
ordered_json sarif_result(const Finding& f, const std::string& folder, const std::vector<ProposedFix>& fixes) {
    if (f.level == Level::Off) return nullptr;
    ordered_json result = {{"ruleId", rule_name(f.rule)},
                           {"ruleIndex", static_cast<size_t>(f.rule)},
                           {"level", level_name(f.level)},
                           {"message", {{"text", sarif_message(f.message) + "\n" + sarif_message(f.remedy)}}},
                           {"locations", ordered_json::array({sarif_location(shown_at(f, folder))})},
                           {"partialFingerprints", {{"porttool/v1", f.fingerprint}}}};
    if (f.source && f.target) {
        ordered_json related = sarif_location(below(folder, *f.target));
        related["id"] = 1;
        related["message"] = {{"text", "the port"}};
        result["relatedLocations"] = ordered_json::array({related});
    }
    if (f.evidence) result["properties"] = {{"evidence", evidence_json(f)}};
    if (f.verdict)
        result["suppressions"] = ordered_json::array({{{"kind", f.settled_in_source ? "inSource" : "external"},
                                                       {"status", "accepted"},
                                                       {"justification", sarif_message(f.verdict_reason)}}});
    const auto fix = std::find_if(fixes.begin(), fixes.end(), [&](const ProposedFix& one) {
        return one.source == f.map_source && one.target == f.map_target;
    });
    if (fix != fixes.end() && is_open(f) && f.level != Level::Note)
        if (ordered_json one = sarif_fix(*fix, folder); !one.is_null())
            result["fixes"] = ordered_json::array({std::move(one)});
    return result;
}

}  // namespace

std::string check_sarif(const Judgement& judgement, const std::string& folder, const std::vector<ProposedFix>& fixes) {
    ordered_json rules = ordered_json::array();
    for (size_t i = 0; i < kRuleNames.size(); ++i)  // all of them: a viewer shows what was looked for
        rules.push_back(sarif_rule(static_cast<Rule>(i)));
    const ordered_json out = {
        {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
        {"version", "2.1.0"},
        {"runs",
         ordered_json::array(
             {{{"tool", {{"driver", {{"name", "porttool"}, {"version", "0.1.0"}, {"rules", rules}}}}},
               {"originalUriBaseIds", {{"%SRCROOT%", {{"description", {{"text", "The root of the repository"}}}}}}},
               {"columnKind", "utf16CodeUnits"},
               {"results", ordered_json::array()}}})}};
    return json_with_rows(out, judgement.findings.size(),
                          [&](size_t i) { return sarif_result(judgement.findings[i], folder, fixes); }) +
           "\n";
}

std::string check_junit(const Judgement& judgement) {
    std::string cases;
    size_t tests = 0, failures = 0;
    for (const Finding& f : judgement.findings) {
        if (!is_open(f) || f.level == Level::Note) continue;
        ++tests;
        const Place place = shown_at(f);
        cases += fmt::format("    <testcase classname=\"porttool.{}\" name=\"{}\" file=\"{}\">\n", rule_name(f.rule),
                             xml_text(place.id), xml_text(place.file));
        if (f.level == Level::Error) {
            ++failures;
            cases += fmt::format("      <failure type=\"{}\" message=\"{}\">{}:{}\n{}</failure>\n", rule_name(f.rule),
                                 xml_text(f.message), xml_text(place.file), place.line, xml_text(f.remedy));
        } else {
            cases += fmt::format("      <system-out>{}\n{}</system-out>\n", xml_text(f.message), xml_text(f.remedy));
        }
        cases += "    </testcase>\n";
    }
    if (tests == 0) {
        tests = 1;
        cases = "    <testcase classname=\"porttool\" name=\"in step\"/>\n";
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"porttool\" tests=\"{}\" "
        "failures=\"{}\" errors=\"0\">\n{}  </testsuite>\n</testsuites>\n",
        tests, failures, cases);
}

std::string check_github(const Judgement& judgement, const std::string& folder) {
    std::string out;
    for (const Finding& f : judgement.findings) {
        if (!is_open(f)) continue;
        const Place place = shown_at(f, folder);
        const char* command = f.level == Level::Error ? "error" : f.level == Level::Warning ? "warning" : "notice";
        out += fmt::format("::{} file={},line={},endLine={},title={}::{}\n", command, workflow_property(place.file),
                           place.line, place.end_line, workflow_property(fmt::format("porttool {}", rule_name(f.rule))),
                           workflow_data(f.message) + kWorkflowLineBreak + workflow_data(f.remedy));
    }
    for (const BroughtIn& one : judgement.brought_in)
        out += fmt::format("::notice file={},line={},title={}::{}\n", workflow_property(folder + one.file), one.line,
                           workflow_property(fmt::format("porttool brought in: {}", gate_part_name(one.kind))),
                           workflow_data(shortened(one.text, kLongestBroughtIn)));
    return out;
}

std::string check_gitlab(const Judgement& judgement, const std::string& folder) {
    const auto row = [&](size_t i) -> ordered_json {
        const Finding& f = judgement.findings[i];
        if (!is_open(f)) return nullptr;
        const Place place = shown_at(f, folder);
        return {{"description", markdown_sentence(f.message + ". " + f.remedy)},
                {"check_name", rule_name(f.rule)},
                {"fingerprint", f.fingerprint},
                {"severity", f.level == Level::Error     ? "major"
                             : f.level == Level::Warning ? "minor"
                                                         : "info"},
                {"location", {{"path", place.file}, {"lines", {{"begin", std::max(1u, place.line)}}}}}};
    };
    return json_with_rows(ordered_json::array(), judgement.findings.size(), row) + "\n";
}

namespace {

/// Forges refuse a comment of more than 65,536 characters: what a change does to the gate shall not go unseen because
/// there are ten thousand findings as well, nor these for its sake.
constexpr size_t kMostOfBoth = 60'000, kMostOfGate = 20'000;

std::string markdown_row(const Finding& f) {
    const auto cell = [](const std::optional<Place>& place) {
        return place ? markdown_text(place->file + ":" + std::to_string(place->line)) : std::string();
    };
    return fmt::format("| {} | {} | {} | {} ({}) |\n", level_name(f.level), cell(f.source), cell(f.target),
                       markdown_cell(shortened(f.message, kLongestBroughtIn)), rule_name(f.rule));
}

/// The open findings as a table; those that are too many to be shown are the least of them.
std::string markdown_findings(const Judgement& judgement, size_t most) {
    std::vector<const Finding*> open;
    for (const Finding& f : judgement.findings)
        if (is_open(f)) open.push_back(&f);
    if (open.empty()) return {};
    std::vector<std::string> rows;
    size_t size = 0;
    for (const Finding* f : open) size += rows.emplace_back(markdown_row(*f)).size();
    if (size > most) {
        std::stable_sort(open.begin(), open.end(),
                         [](const Finding* a, const Finding* b) { return a->level > b->level; });
        rows.clear();
        size = 0;
        for (const Finding* f : open) {
            std::string row = markdown_row(*f);
            size += row.size();
            if (size > most) break;
            rows.push_back(std::move(row));
        }
    }
    std::string out = "\n| | source | port | finding |\n| --- | --- | --- | --- |\n";
    for (const std::string& row : rows) out += row;
    if (rows.size() < open.size())
        out += fmt::format("\nand {} more; --format json lists all\n", open.size() - rows.size());
    return out;
}

std::string markdown_brought_in(const std::vector<BroughtIn>& brought_in) {
    if (brought_in.empty()) return {};
    std::string out = "\nWhat this change does to the gate itself:\n\n| | where | what |\n| --- | --- | --- |\n";
    size_t shown = 0;
    for (; shown < brought_in.size(); ++shown) {
        const BroughtIn& one = brought_in[shown];
        const std::string row = fmt::format("| {} | {} | {} |\n", gate_part_name(one.kind),
                                            markdown_text(one.file + ":" + std::to_string(one.line)),
                                            markdown_text(shortened(one.text, kLongestBroughtIn)));
        if (out.size() + row.size() > kMostOfGate) break;
        out += row;
    }
    const std::string more = more_brought_in(brought_in, shown);
    return more.empty() ? out : out + "\n" + more + "\n";
}

}  // namespace

std::string check_markdown(const Judgement& judgement) {
    const Summary& s = judgement.summary;
    const std::string gate = markdown_brought_in(judgement.brought_in);
    return fmt::format(
               "### porttool: {}\n\n{} pairs: {} in step, {} drifted, {} to review, {} deferred, {} ignored; {}.\n",
               gate_result_name(judgement.result()), s.pairs, s.in_step, s.drifted, s.review, s.deferred, s.ignored,
               unwatched_text(s, judgement.reference) + verified_text(s)) +
           markdown_findings(judgement, kMostOfBoth - gate.size()) + gate;
}

}  // namespace porttool

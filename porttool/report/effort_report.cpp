// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/effort_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "porttool/report/figures.h"
#include "porttool/text/date.h"
#include "porttool/text/sink/csv.h"
#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/toml_string.h"
#include "porttool/text/utf8.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;

std::string share_text(const std::optional<double>& share) { return share ? fmt::format("{:.2f}", *share) : "-"; }

std::string edit_text(const LineEdit& edit) { return fmt::format("+{} -{}", edit.added, edit.removed); }

std::string inputs_text(const metrics::Figure& figure) {
    std::string out;
    for (const metrics::FigureInput& input : figure.inputs)
        out += fmt::format("{}{} {:.4g}{}{}", out.empty() ? "" : ", ", input.name, input.value,
                           input.unit == "percent" ? " %"
                           : input.unit == "hours" ? " h"
                                                   : "",
                           "");
    return out;
}

std::string row(const std::string& name, const PortedEdit& edit, const metrics::LineWeights& weights) {
    return fmt::format("  {:<12} {:<12} {:>8} {:>8} {:>8}  {:<21} {}\n", edit_text(edit.source), edit_text(edit.target),
                       share_text(edit.carried_over()), edit.novel(), share_text(edit.similarity()),
                       figure_text(degree_of_edit(edit, weights)), terminal_text(name));
}

LineEdit sum(const std::vector<FileEffort>& files) {
    LineEdit total;
    for (const FileEffort& file : files) {
        total.added += file.edit.added;
        total.removed += file.edit.removed;
    }
    return total;
}

std::string files_text(const std::vector<FileEffort>& files) {
    return files.size() == 1 ? files.front().file : fmt::format("{} files", files.size());
}

/// An edit of the port of which nothing is carried over.
PortedEdit novel_edit(const LineEdit& edit) {
    PortedEdit out;
    out.target = edit;
    out.carried.lines = static_cast<double>(edit.added);
    return out;
}

ordered_json edit_json(const PortedEdit& edit, const metrics::LineWeights& weights) {
    return {{"source_added", edit.source.added},
            {"source_removed", edit.source.removed},
            {"target_added", edit.target.added},
            {"target_removed", edit.target.removed},
            {"novel_lines", edit.novel()},
            {"carried_lines", edit.carried.shared},
            {"carried_over", number_json(edit.carried_over())},
            {"edit_similarity", number_json(edit.similarity())},
            {"degree_of_portability", figure_json(degree_of_edit(edit, weights))}};
}

ordered_json outside_json(const std::vector<FileEffort>& files) {
    ordered_json out = ordered_json::array();
    for (const FileEffort& file : files)
        out.push_back({{"file", file.file}, {"added", file.edit.added}, {"removed", file.edit.removed}});
    return out;
}

std::string csv_line(const char* kind, const std::string& source, const std::string& target, const PortedEdit& edit,
                     const metrics::LineWeights& weights) {
    const auto number = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.6g}", *value) : std::string();
    };
    const std::optional<metrics::Figure> degree = degree_of_edit(edit, weights);
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", kind, csv_field(source), csv_field(target),
                       edit.source.added, edit.source.removed, edit.target.added, edit.target.removed, edit.novel(),
                       number(edit.carried_over()), number(edit.similarity()), degree ? number(degree->value) : "",
                       degree ? number(degree->low) : "", degree ? number(degree->high) : "");
}

}  // namespace

std::optional<metrics::Figure> degree_of_edit(const PortedEdit& edit, const metrics::LineWeights& weights) {
    return metrics::degree_from_lines(edit.carried, weights);
}

std::string effort_table(const RangeEffort& report) {
    const PortEffort& effort = report.effort;
    std::string out = fmt::format("{}..{}: {} commits, {} to {}\n", short_id(report.from.id), short_id(report.to.id),
                                  report.commits, day_of(report.from.time), day_of(report.to.time));
    if (effort.totals.source.changed() + effort.totals.target.changed() == 0)
        return out + "no line of code changed on either side\n";
    out += fmt::format("  {:<12} {:<12} {:>8} {:>8} {:>8}  {:<21}\n", "source", "port", "carried", "novel", "alike",
                       "DP in lines");
    for (const PairEffort& pair : effort.pairs)
        out += row(pair.source + "  =  " + pair.target + (pair.suggested ? "  (suggested)" : ""), pair.edit,
                   report.weights);
    if (!effort.source_outside.empty())
        out += row(files_text(effort.source_outside) + " of the source, outside pairs",
                   {sum(effort.source_outside), {}, 0, {}, 0, 0, 0}, report.weights);
    if (!effort.target_outside.empty())
        out += row(files_text(effort.target_outside) + " of the port, outside pairs",
                   novel_edit(sum(effort.target_outside)), report.weights);
    out += row("in all", effort.totals, report.weights);
    out += "degree of portability of this change, 1 - cost of the port / cost of redevelopment:\n";
    for (const metrics::Figure& degree : report.degrees)
        out += fmt::format("  {:<28} {}  from {}\n", degree.model, figure_text(degree), inputs_text(degree));
    for (const auto& hours : {report.hours, report.hours_by_law})
        if (hours)
            out += fmt::format("hours of this port by the ledger ({}): {}  from {}\n", hours->model, figure_text(hours),
                               inputs_text(*hours));
    if (report.ledger_degree)
        out += fmt::format("degree of portability of all recorded ports, in hours: {}  from {}\n",
                           figure_text(report.ledger_degree), inputs_text(*report.ledger_degree));
    for (const auto& [block, degree] : report.ledger_blocks)
        out += fmt::format("  of the block {}: {}  from {}\n", terminal_text(block), figure_text(degree),
                           inputs_text(degree));
    for (const std::string& missing : report.missing) out += "not given: " + terminal_text(missing) + "\n";
    return out;
}

std::string effort_json(const RangeEffort& report) {
    const PortEffort& effort = report.effort;
    ordered_json pairs = ordered_json::array();
    for (const PairEffort& pair : effort.pairs) {
        ordered_json one = {
            {"source", pair.source}, {"target", pair.target}, {"state", pair.suggested ? "suggested" : "confirmed"}};
        one.update(edit_json(pair.edit, report.weights));
        pairs.push_back(std::move(one));
    }
    ordered_json degrees = ordered_json::array();
    for (const metrics::Figure& degree : report.degrees) degrees.push_back(figure_json(degree));
    ordered_json ledger = ordered_json::array();
    for (const auto& [block, degree] : report.ledger_blocks)
        ledger.push_back({{"block", block}, {"degree_of_portability", figure_json(degree)}});
    const ordered_json out = {{"from", report.from.id},
                              {"to", report.to.id},
                              {"commits", report.commits},
                              {"totals", edit_json(effort.totals, report.weights)},
                              {"pairs", pairs},
                              {"source_outside_pairs", outside_json(effort.source_outside)},
                              {"target_outside_pairs", outside_json(effort.target_outside)},
                              {"degrees_of_portability", degrees},
                              {"predicted_hours", figure_json(report.hours)},
                              {"predicted_hours_by_law", figure_json(report.hours_by_law)},
                              {"ledger_degree_of_portability", figure_json(report.ledger_degree)},
                              {"ledger_blocks", ledger},
                              {"not_given", report.missing}};
    return json_text(out, 1) + "\n";
}

std::string effort_csv(const RangeEffort& report) {
    std::string out =
        "kind,source,target,source_added,source_removed,target_added,target_removed,novel_lines,carried_over,"
        "edit_similarity,degree_of_portability_lines,low,high\n";
    for (const PairEffort& pair : report.effort.pairs)
        out +=
            csv_line(pair.suggested ? "suggested pair" : "pair", pair.source, pair.target, pair.edit, report.weights);
    for (const FileEffort& file : report.effort.source_outside)
        out += csv_line("outside", file.file, "", {file.edit, {}, 0, {}, 0, 0, 0}, report.weights);
    for (const FileEffort& file : report.effort.target_outside)
        out += csv_line("outside", "", file.file, novel_edit(file.edit), report.weights);
    return out + csv_line("total", "", "", report.effort.totals, report.weights);
}

std::string effort_toml(const RangeEffort& report) {
    const PortedEdit& totals = report.effort.totals;
    return fmt::format(
        "[[effort]]\nwhat = {}\nfrom = \"{}\"\nto = \"{}\"\nlines = {}\nnovel = {}\n"
        "# Hours, where they are known:\n"
        "# port = {{ coding = 0, testing = 0, documentation = 0 }}\n"
        "# redevelopment = {{ design = 0, coding = 0, testing = 0, documentation = 0 }}\n",
        toml_string(as_utf8(report.to.subject)), report.from.id, report.to.id, totals.target.added, totals.novel());
}

}  // namespace porttool

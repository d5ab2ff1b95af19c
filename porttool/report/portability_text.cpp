// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/portability_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "porttool/report/check_report.h"
#include "porttool/report/figures.h"
#include "porttool/report/matrix_report.h"
#include "porttool/text/sink/csv.h"
#include "porttool/text/sink/markdown.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

constexpr const char* kTooShort = "too short";

/// A side without lines has no share to speak of, nor has one whose counterpart is empty.
std::string moss_text(const BlockReport& block, Side side) {
    const SideMeasure& measure = block.found[side].measure;
    if (measure.moss_percent) return bounded_text(*measure.moss_percent, 100, 1) + " %";
    if (measure.lines == 0) return "-";
    if (block.found[other(side)].measure.lines == 0) return side == Side::Source ? "no target" : "no source";
    return kTooShort;
}

std::string shared_text(const BlockReport& block, Side side, const char* unknown) {
    return block.is_too_short() ? unknown : std::to_string(block.found[side].measure.shared_lines);
}

/// " ▲ +3" or " ▼ -3"; nothing where nothing changed or nothing is known.
std::string arrow(const std::optional<double>& change, int digits) {
    if (!change) return {};
    const std::string text = fmt::format("{:.{}f}", std::abs(*change), digits);
    if (text.find_first_not_of("0.") == std::string::npos) return {};
    return *change > 0 ? " ▲ +" + text : " ▼ -" + text;
}

constexpr const char* kNothingRecorded = "nothing recorded";

std::string verdict_words(const WholeReport& whole) {
    if (!whole.is_recorded) return kNothingRecorded;
    const GateResult result = whole.judgement.result();
    if (result == GateResult::Drift) return "drifted";
    return result == GateResult::Review ? "to review" : "in step";
}

std::string summary_line(const WholeReport& whole) {
    if (!whole.is_recorded) return "there is no portmap.lock yet; porttool init records the present state of the pairs";
    const Summary& s = whole.judgement.summary;
    return fmt::format("{} of {} pairs in step, {} drifted, {} to review, {} deferred, {} ignored; {}", s.in_step,
                       s.pairs, s.drifted, s.review, s.deferred, s.ignored,
                       unwatched_text(s, whole.judgement.reference) + verified_text(s));
}

/// A block with what it is compared with, if anything.
struct Shown {
    std::string name;
    const BlockReport* block;
    std::optional<BlockChange> change;
};

std::vector<Shown> shown_blocks(const WholeReport& whole) {
    std::vector<Shown> out;
    const auto add = [&](const std::string& name, const BlockReport& block, const BlockReport* then) {
        out.push_back({name, &block, then != nullptr ? std::optional(change_of(block, *then)) : std::nullopt});
    };
    for (const BlockReport& block : whole.report.blocks)
        add(block.name, block, whole.base ? find_block(whole.base->report.blocks, block.name) : nullptr);
    add("All lines", whole.report.totals, whole.base ? &whole.base->report.totals : nullptr);
    return out;
}

std::string block_rows(const WholeReport& whole) {
    std::string out =
        "| block | source lines | shared | Moss % | target lines | shared | Moss % | degree of portability |\n"
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
    for (const Shown& shown : shown_blocks(whole)) {
        const BlockChange change = shown.change.value_or(BlockChange());
        out += "| " + markdown_text(shown.name) + " |";
        for (const Side side : kBothSides) {
            const SideMeasure& measure = shown.block->found[side].measure;
            out += fmt::format(" {}{} | {}{} | {}{} |", measure.lines, arrow(change.lines[side], 0),
                               shared_text(*shown.block, side, "-"), arrow(change.shared[side], 0),
                               moss_text(*shown.block, side), arrow(change.moss[side], 1));
        }
        out += fmt::format(" {}{} |\n", figure_text(shown.block->degree), arrow(change.degree, 2));
    }
    return out;
}

std::string part_rows(const PortabilityReport& report) {
    std::string out =
        "| | twin | rewritten | one-sided | unmatched | all |\n| --- | ---: | ---: | ---: | ---: | ---: |\n";
    for (const Side side : kBothSides) {
        const LineParts& parts = report.totals.parts[side];
        out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", side == Side::Source ? "source lines" : "target lines",
                           parts.twin, parts.rewritten, parts.one_sided, parts.unmatched, parts.total());
    }
    return out;
}

std::string open_findings(const WholeReport& whole) {
    std::string out;
    for (const LedgerRow& row : whole.ledger.rows) {
        const Finding& f = *row.finding;
        if (row.status == "ignored") continue;
        if (out.empty()) out = "\n| | source | port | finding |\n| --- | --- | --- | --- |\n";
        const std::string note = row.until.empty() ? "" : " Deferred until " + row.until + " to " + row.owner + ".";
        out += fmt::format("| {} | {} | {} | {} ({}){} |\n", row.status == "open" ? level_name(f.level) : "deferred",
                           markdown_code(f.source ? f.source->id : f.map_source),
                           markdown_code(f.target ? f.target->id : f.map_target), markdown_text(f.message),
                           rule_name(f.rule), markdown_text(note));
    }
    return out;
}

std::string details(const std::string& title, const std::vector<std::string>& items) {
    if (items.empty()) return {};
    std::string out = fmt::format("\n<details><summary>{}: {}</summary>\n\n", title, items.size());
    for (const std::string& item : items) out += "- " + item + "\n";
    return out + "\n</details>\n";
}

std::string lines_text(size_t lines) { return std::to_string(lines) + (lines == 1 ? " line" : " lines"); }

/// Where the figures lead: pairs that are not twins, and what has no counterpart.
std::string where_to_look(const PortabilityReport& report) {
    std::vector<std::string> rewritten, unmatched, outside;
    for (const RowReport& row : report.rows) {
        const RowSide& side = row.first();
        if (row.share == Share::Rewritten)
            rewritten.push_back(fmt::format("{} and {}: {}", markdown_code(side.id),
                                            markdown_code(row.sides.target->id),
                                            row.likeness ? fmt::format("{:.0f} %", *row.likeness) : kTooShort));
        if (row.share != Share::Unmatched || side.lines == 0) continue;
        const bool is_unit = side.excerpt.unit != nullptr;
        (is_unit ? unmatched : outside)
            .push_back(fmt::format("{}: {}", markdown_code(is_unit ? side.id : side.file), lines_text(side.lines)));
    }
    return details("Rewritten pairs", rewritten) + details("Units without counterpart", unmatched) +
           details("Files with code outside units", outside);
}

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.4f}", *value) : std::string(); }

void add_change_fields(std::string& out, const std::optional<BlockChange>& change) {
    const BlockChange c = change.value_or(BlockChange());
    const auto count = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.0f}", *value) : std::string();
    };
    out += fmt::format(",{},{},{},{},{},{},{}", count(c.lines.source), count(c.lines.target), count(c.shared.source),
                       count(c.shared.target), number(c.moss.source), number(c.moss.target), number(c.degree));
}

std::string rate_text(const std::optional<double>& rate) {
    return rate ? fmt::format("{:.2f}", *rate) : std::string("not known");
}

/// A table in Markdown with the harmonic mean below, or nothing without platforms.
std::string performance_markdown(const Performance& performance) {
    if (performance.platforms.empty()) return {};
    std::string out = "\n| platform | Mrays/s | of at most | efficiency |\n| --- | ---: | ---: | ---: |\n";
    for (const PlatformSpeed& platform : performance.platforms) {
        const std::optional<double> efficiency = platform.efficiency();
        out += fmt::format("| {} | {:.2f} | {} | {} |\n", markdown_text(platform.name), platform.achieved,
                           rate_text(platform.limit), efficiency ? fmt::format("{:.2f}", *efficiency) : "not known");
    }
    const std::optional<double> portability = performance.portability();
    return out + "\nPerformance portability (harmonic mean of the efficiencies): " +
           (portability ? fmt::format("{:.2f}", *portability) : "not known; name each limit, --bench FILE=MRAYS") +
           ".\n";
}

}  // namespace

std::string portability_table(const WholeReport& whole) {
    const std::vector<Shown> blocks = shown_blocks(whole);
    size_t width = 5;
    for (const Shown& shown : blocks) width = std::max(width, terminal_line(shown.name).size());
    std::string out = fmt::format("{}: {}\n\n", verdict_words(whole), summary_line(whole));
    out += fmt::format("{:<{}}  {:>12} {:>7} {:>9}  {:>12} {:>7} {:>9}  {}\n", "block", width, "source lines", "shared",
                       "Moss", "target lines", "shared", "Moss", "degree of portability");
    for (const Shown& shown : blocks) {
        const SideMeasure &a = shown.block->found.source.measure, &b = shown.block->found.target.measure;
        out += fmt::format("{:<{}}  {:>12} {:>7} {:>9}  {:>12} {:>7} {:>9}  {}\n", terminal_line(shown.name), width,
                           a.lines, shared_text(*shown.block, Side::Source, "-"), moss_text(*shown.block, Side::Source),
                           b.lines, shared_text(*shown.block, Side::Target, "-"), moss_text(*shown.block, Side::Target),
                           figure_text(shown.block->degree));
        if (!shown.change) continue;
        const BlockChange& c = *shown.change;
        const std::string changes = arrow(c.lines.source, 0) + arrow(c.shared.source, 0) + arrow(c.moss.source, 1) +
                                    arrow(c.lines.target, 0) + arrow(c.shared.target, 0) + arrow(c.moss.target, 1) +
                                    arrow(c.degree, 2);
        if (changes.empty()) continue;
        out += fmt::format("{:<{}}  {:>12} {:>7} {:>9}  {:>12} {:>7} {:>9}  {}\n", "", width, arrow(c.lines.source, 0),
                           arrow(c.shared.source, 0), arrow(c.moss.source, 1), arrow(c.lines.target, 0),
                           arrow(c.shared.target, 0), arrow(c.moss.target, 1), arrow(c.degree, 2));
    }
    if (!whole.performance.platforms.empty()) out += performance_markdown(whole.performance);
    for (const Side side : kBothSides) {
        const LineParts& parts = whole.report.totals.parts[side];
        out += fmt::format("{}{}: {} lines = {} twin + {} rewritten + {} one-sided + {} unmatched\n",
                           side == Side::Source ? "\n" : "", side == Side::Source ? "source" : "target", parts.total(),
                           parts.twin, parts.rewritten, parts.one_sided, parts.unmatched);
    }
    return out + matrix_table(whole.matrix);
}

std::string portability_markdown(const WholeReport& whole) {
    std::string out = "<!-- Made by: porttool report --format markdown -->\n";
    out += fmt::format("### Port: {}\n\n{}.\n", verdict_words(whole), summary_line(whole));
    if (whole.base)
        out += fmt::format("Changes are against the merge base with {}.\n", markdown_code(whole.base->revision));
    out += open_findings(whole);
    out += "\n" + block_rows(whole) + "\n" + part_rows(whole.report);
    out += matrix_markdown(whole.matrix) + performance_markdown(whole.performance);
    out += where_to_look(whole.report);
    return out;
}

std::string portability_csv(const WholeReport& whole) {
    std::string out =
        "block,source_lines,target_lines,shared_source,shared_target,moss_percent_source,moss_percent_target,"
        "moss_percent_blind_source,moss_percent_blind_target,moss_percent_raw_source,moss_percent_raw_target,"
        "degree_of_portability,degree_low,degree_high,degree_model";
    if (whole.base)
        out +=
            ",source_lines_change,target_lines_change,shared_source_change,shared_target_change,"
            "moss_percent_source_change,moss_percent_target_change,degree_of_portability_change";
    out += "\r\n";
    for (const BlockReport& block : whole.report.blocks) {
        const SideMeasure &a = block.found.source.measure, &b = block.found.target.measure;
        out += fmt::format("{},{},{},{},{},{},{},{},{},{},{}", csv_field(block.name), a.lines, b.lines,
                           shared_text(block, Side::Source, ""), shared_text(block, Side::Target, ""),
                           number(a.moss_percent), number(b.moss_percent), number(a.moss_percent_blind),
                           number(b.moss_percent_blind), number(a.moss_percent_raw), number(b.moss_percent_raw));
        if (const auto& dp = block.degree)
            out += fmt::format(",{:.4f},{:.4f},{:.4f},{}", dp->value, dp->low, dp->high, csv_field(dp->model));
        else
            out += ",,,,";
        if (whole.base) {
            const BlockReport* then = find_block(whole.base->report.blocks, block.name);
            add_change_fields(out, then != nullptr ? std::optional(change_of(block, *then)) : std::nullopt);
        }
        out += "\r\n";
    }
    return out;
}

}  // namespace porttool

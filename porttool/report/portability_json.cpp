// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/portability_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "porttool/report/figures.h"
#include "porttool/report/matrix_report.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;

const BySide<std::string> kSides = {"source", "target"};

ordered_json text_or_null(const std::string& text) { return text.empty() ? ordered_json(nullptr) : ordered_json(text); }

ordered_json spans_json(const std::vector<LineSpan>& spans) {
    ordered_json out = ordered_json::array();
    for (const LineSpan& span : spans) out.push_back({span.first, span.last});
    return out;
}

void add_percents(ordered_json& out, Side side, const SideMeasure& measure) {
    out["moss_percent_" + kSides[side]] = number_json(measure.moss_percent);
    out["moss_percent_blind_" + kSides[side]] = number_json(measure.moss_percent_blind);
    out["moss_percent_raw_" + kSides[side]] = number_json(measure.moss_percent_raw);
}

ordered_json parts_json(const LineParts& parts) {
    return {{"twin", parts.twin},
            {"rewritten", parts.rewritten},
            {"one_sided", parts.one_sided},
            {"unmatched", parts.unmatched},
            {"total", parts.total()}};
}

ordered_json lines_json(const std::vector<FileLines>& lines) {
    ordered_json out = ordered_json::array();
    for (const FileLines& file : lines)
        out.push_back({{"file", file.file}, {"code", spans_json(file.code)}, {"shared", spans_json(file.shared)}});
    return out;
}

ordered_json count_json(const std::optional<double>& change) {
    return change ? ordered_json(static_cast<int64_t>(*change)) : ordered_json(nullptr);
}

ordered_json change_json(const BlockChange& change) {
    ordered_json out;
    for (const Side side : kBothSides) out[kSides[side] + "_lines"] = count_json(change.lines[side]);
    for (const Side side : kBothSides) out["shared_" + kSides[side]] = count_json(change.shared[side]);
    for (const Side side : kBothSides) out["moss_percent_" + kSides[side]] = number_json(change.moss[side]);
    out["degree_of_portability"] = number_json(change.degree);
    return out;
}

ordered_json block_json(const BlockReport& block, const BlockReport* then, bool with_change) {
    ordered_json out = measured_block_json(block);
    add_details(out, block);
    if (with_change) out["change"] = then != nullptr ? change_json(change_of(block, *then)) : ordered_json(nullptr);
    return out;
}

ordered_json side_json(const std::optional<RowSide>& side) {
    if (!side) return nullptr;
    return {{"id", side->id},
            {"file", side->file},
            {"name", side->name},
            {"kind", side->kind},
            {"line", side->span.first},
            {"end_line", side->span.last},
            {"lines", side->lines},
            {"code", spans_json(side->code)},
            {"shared", spans_json(side->shared)}};
}

ordered_json row_json(const RowReport& row, const std::vector<BlockReport>& blocks) {
    ordered_json out = {{"key", row.key},
                        {"share", share_name(row.share)},
                        {"state", text_or_null(row.state)},
                        {"reason", text_or_null(row.reason)},
                        {"source", side_json(row.sides.source)},
                        {"target", side_json(row.sides.target)}};
    if (row.sides.source && row.sides.target) {
        for (const Side side : kBothSides) add_percents(out, side, row.measures[side]);
        out["likeness"] = number_json(row.likeness);
    }
    const int block = row.first().block;
    out["block"] = block < 0 ? ordered_json(nullptr) : ordered_json(blocks[block].name);
    out["blocks"] = ordered_json::array();
    for (size_t i = 0; i < blocks.size(); ++i) {
        const auto in = [&](const std::optional<RowSide>& side) {
            return side &&
                   std::find(side->blocks.begin(), side->blocks.end(), static_cast<int>(i)) != side->blocks.end();
        };
        if (in(row.sides.source) || in(row.sides.target)) out["blocks"].push_back(blocks[i].name);
    }
    return out;
}

template <class T>
ordered_json or_null(const std::optional<T>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json ledger_row_json(const LedgerRow& row) {
    const Finding& f = *row.finding;
    return {{"status", row.status},
            {"rule", rule_name(f.rule)},
            {"level", level_name(f.level)},
            {"change", f.change ? ordered_json(change_name(*f.change)) : ordered_json(nullptr)},
            {"source", place_json(f.source)},
            {"target", place_json(f.target)},
            {"pair", f.map_target.empty() ? f.map_source : f.map_source + "=" + f.map_target},
            {"message", f.message},
            {"details", f.details},
            {"remedy", f.remedy},
            {"fingerprint", f.fingerprint},
            {"age_days", or_null(row.age_days)},
            {"age_is_least", row.age_is_least},
            {"owner", text_or_null(row.owner)},
            {"until", text_or_null(row.until)},
            {"days_left", or_null(row.days_left)},
            {"reason", text_or_null(row.reason)}};
}

ordered_json drift_json(const WholeReport& whole) {
    ordered_json out = {{"verdict", nullptr}, {"summary", nullptr}};
    if (whole.is_recorded)
        out = {{"verdict", gate_result_name(whole.judgement.result())},
               {"summary", summary_json(whole.judgement.summary)}};
    if (whole.base) {
        out["change"] = nullptr;
        if (whole.is_recorded && whole.base->drift) {
            const ordered_json now = out["summary"], then = summary_json(*whole.base->drift);
            ordered_json change = ordered_json::object();
            for (const auto& [name, value] : now.items())
                change[name] = value.get<int64_t>() - then[name].get<int64_t>();
            out["change"] = change;
        }
    }
    out["as_of"] = whole.today;
    out["findings"] = ordered_json::array();
    for (const LedgerRow& row : whole.ledger.rows) out["findings"].push_back(ledger_row_json(row));
    out["accepted"] = ordered_json::array();
    for (const AcceptedRow& row : whole.ledger.accepted)
        out["accepted"].push_back({{"source", row.source},
                                   {"target", row.target},
                                   {"date", row.date},
                                   {"reason", row.reason},
                                   {"age_days", or_null(row.age_days)}});
    return out;
}

ordered_json own_blocks_json(const PortabilityReport& report) {
    ordered_json out = ordered_json::array();
    const auto add = [&](const ordered_json& name, const BySide<LineCount>& alone, bool known) {
        const auto shared = [&](Side side) { return known ? ordered_json(alone[side].shared) : ordered_json(nullptr); };
        out.push_back({{"name", name},
                       {"source_lines", alone.source.lines},
                       {"source_shared", shared(Side::Source)},
                       {"target_lines", alone.target.lines},
                       {"target_shared", shared(Side::Target)}});
    };
    for (const BlockReport& block : report.blocks) add(block.name, block.alone, !block.is_too_short());
    add(nullptr, report.in_no_block, !report.totals.is_too_short());
    return out;
}

/// Null without platforms.
ordered_json performance_json(const Performance& performance) {
    if (performance.platforms.empty()) return nullptr;
    ordered_json platforms = ordered_json::array();
    for (const PlatformSpeed& platform : performance.platforms)
        platforms.push_back({{"name", platform.name},
                             {"achieved_mrays_per_s", platform.achieved},
                             {"limit_mrays_per_s", or_null(platform.limit)},
                             {"efficiency", or_null(platform.efficiency())}});
    return {{"platforms", platforms}, {"performance_portability", or_null(performance.portability())}};
}

std::optional<double> difference(const std::optional<double>& now, const std::optional<double>& then) {
    if (!now || !then) return std::nullopt;
    return *now - *then;
}

}  // namespace

ordered_json measured_block_json(const MeasuredBlock& block) {
    const SideMeasure &source = block.found.source.measure, &target = block.found.target.measure;
    const auto shared = [&](const SideMeasure& side) {
        return block.is_too_short() ? ordered_json(nullptr) : ordered_json(side.shared_lines);
    };
    ordered_json out;
    if (!block.name.empty()) out["name"] = block.name;
    out["source_lines"] = source.lines;
    out["target_lines"] = target.lines;
    out["shared_source"] = shared(source);
    out["shared_target"] = shared(target);
    add_percents(out, Side::Source, source);
    add_percents(out, Side::Target, target);
    out["degree_of_portability"] = figure_json(block.degree);
    return out;
}

void add_details(ordered_json& out, const BlockReport& block) {
    for (const Side side : kBothSides) {
        out["decomposition"][kSides[side]] = parts_json(block.parts[side]);
        out["lines"][kSides[side]] = lines_json(block.lines[side]);
    }
}

BlockChange change_of(const BlockReport& now, const BlockReport& then) {
    BlockChange change;
    for (const Side side : kBothSides) {
        const SideMeasure &a = now.found[side].measure, &b = then.found[side].measure;
        change.lines[side] = static_cast<double>(a.lines) - b.lines;
        if (!now.is_too_short() && !then.is_too_short())
            change.shared[side] = static_cast<double>(a.shared_lines) - b.shared_lines;
        change.moss[side] = difference(a.moss_percent, b.moss_percent);
    }
    if (now.degree && then.degree) change.degree = now.degree->value - then.degree->value;
    return change;
}

const BlockReport* find_block(const std::vector<BlockReport>& blocks, const std::string& name) {
    const auto found =
        std::find_if(blocks.begin(), blocks.end(), [&](const BlockReport& block) { return block.name == name; });
    return found == blocks.end() ? nullptr : &*found;
}

ordered_json portability_json(const WholeReport& whole) {
    const PortabilityReport& report = whole.report;
    const bool with_change = whole.base.has_value();
    ordered_json blocks = ordered_json::array(), rows = ordered_json::array();
    for (const BlockReport& block : report.blocks)
        blocks.push_back(
            block_json(block, with_change ? find_block(whole.base->report.blocks, block.name) : nullptr, with_change));
    for (const RowReport& row : report.rows) rows.push_back(row_json(row, report.blocks));
    ordered_json out = {
        {"blocks", blocks},
        {"totals", block_json(report.totals, with_change ? &whole.base->report.totals : nullptr, with_change)},
        {"drift", drift_json(whole)},
        {"units", rows},
        {"own_blocks", own_blocks_json(report)},
        {"blocks_are_file_pairs", report.blocks_are_file_pairs},
        {"sides", {{"source", whole.map.source}, {"target", whole.map.target}}},
        {"parameters",
         {{"k", metrics::WinnowingParameters{}.k},
          {"w", metrics::WinnowingParameters{}.w},
          {"twin_percent", kTwinBound}}}};
    out["performance"] = performance_json(whole.performance);
    out["matrix"] = matrix_json(whole.matrix);
    out["base"] = nullptr;
    if (with_change) out["base"] = {{"revision", whole.base->revision}};
    return out;
}

}  // namespace porttool

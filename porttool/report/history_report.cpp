// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/history_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "porttool/report/figures.h"
#include "porttool/report/portability_json.h"
#include "porttool/text/date.h"
#include "porttool/text/sink/csv.h"
#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;

constexpr double kSecondsOfDay = 86400;

/// A block as in a report; of what its lines are only the newest commit's says something.
ordered_json block_json(const MeasuredBlock& block, const BlockReport* full) {
    ordered_json out = measured_block_json(block);
    out["decomposition"] = nullptr;
    out["lines"] = nullptr;
    if (full != nullptr) add_details(out, *full);
    return out;
}

std::string csv_number(const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : ""; }

std::string shared_text(const MeasuredBlock& block, Side side, const char* too_short) {
    return block.is_too_short() ? too_short : std::to_string(block.found[side].measure.shared_lines);
}

std::string csv_line(const HistoryPoint& point, const MeasuredBlock& block, const std::string& drift) {
    const auto degree = [&](double metrics::Figure::*part) {
        return block.degree ? csv_number((*block.degree).*part) : std::string();
    };
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", point.commit.id, day_of(point.commit.time),
                       csv_field(block.name), block.found.source.measure.lines, block.found.target.measure.lines,
                       shared_text(block, Side::Source, ""), shared_text(block, Side::Target, ""),
                       csv_number(block.found.source.measure.moss_percent),
                       csv_number(block.found.target.measure.moss_percent), degree(&metrics::Figure::value),
                       degree(&metrics::Figure::low), degree(&metrics::Figure::high), drift);
}

std::string percent_text(const std::optional<double>& percent) {
    return percent ? bounded_text(*percent, 100, 0) + " %" : "-";
}

}  // namespace

std::string history_json(const History& history) {
    ordered_json commits = ordered_json::array();
    for (const HistoryPoint& point : history.points) {
        const bool is_full = &point == &history.points.back() && history.newest.size() == point.blocks.size() + 1;
        const auto full = [&](size_t i) { return is_full ? &history.newest[i] : nullptr; };
        ordered_json blocks = ordered_json::array();
        for (const MeasuredBlock& block : point.blocks) blocks.push_back(block_json(block, full(blocks.size())));
        commits.push_back({{"id", point.commit.id},
                           {"date", day_of(point.commit.time)},
                           {"time_s", point.commit.time},
                           {"subject", point.commit.subject},
                           {"blocks", std::move(blocks)},
                           {"totals", block_json(point.totals, full(point.blocks.size()))},
                           {"drift",
                            {{"pairs", point.pairs},
                             {"open_pairs", point.open_pairs},
                             {"debt_line_days", number_json(point.debt)},
                             {"debt_before_line_days", number_json(point.debt_before)}}}});
    }
    ordered_json open = ordered_json::array();
    const int64_t now = history.points.empty() ? 0 : history.points.back().commit.time;
    for (const OpenPair& pair : history.open)
        open.push_back({{"source", pair.id.first},
                        {"target", pair.id.second},
                        {"since", day_of(pair.since)},
                        {"age_days", number_json(static_cast<double>(now - pair.since) / kSecondsOfDay)},
                        {"lines", pair.lines},
                        {"debt_line_days", number_json(pair.debt(now))}});
    ordered_json churn = ordered_json::array();
    for (size_t i = 0; i < history.churn.size(); ++i) {
        const MeasuredBlock& block = history.points.back().blocks[i];
        const auto& percent = block.found.target.measure.moss_percent;
        churn.push_back({{"name", block.name},
                         {"commits", history.churn[i].commits},
                         {"commits_per_100_lines", number_json(history.churn[i].per_100_lines)},
                         {"moss_percent_target", percent ? number_json(*percent) : ordered_json(nullptr)}});
    }
    const auto& correlation = history.churn_and_likeness;
    const ordered_json out = {
        {"commits_read", history.commits},
        {"shallow", history.cut},
        {"oldest", {{"id", history.oldest.id}, {"date", day_of(history.oldest.time)}}},
        {"commits", std::move(commits)},
        {"open", std::move(open)},
        {"churn",
         {{"blocks", std::move(churn)},
          {"rank_correlation", correlation ? number_json(*correlation) : ordered_json(nullptr)}}}};
    return json_text(out, 1) + "\n";
}

std::string history_csv(const History& history) {
    std::string out =
        "commit,date,block,source_lines,target_lines,shared_source,shared_target,moss_percent_source,"
        "moss_percent_target,degree_of_portability,low,high,open_pairs,debt_line_days\n";
    for (const HistoryPoint& point : history.points) {
        for (const MeasuredBlock& block : point.blocks) out += csv_line(point, block, ",");
        MeasuredBlock totals = point.totals;
        totals.name = "*";
        out += csv_line(point, totals, fmt::format("{},{:.6g}", point.open_pairs, point.debt));
    }
    return out;
}

std::string history_table(const History& history) {
    std::string out = fmt::format(
        "{} commits read, back to {} ({}); {} shown: those that touch the sides or their map, and the newest\n",
        history.commits, short_id(history.oldest.id), day_of(history.oldest.time), history.points.size());
    if (history.points.empty()) return out;
    out += "date        commit      shared lines    Moss %  DP in lines            open pairs  debt (line-days)\n";
    constexpr size_t kShown = 24;
    const size_t first = history.points.size() > kShown ? history.points.size() - kShown : 0;
    if (first > 0) out += fmt::format("({} older ones: --format csv, json or html)\n", first);
    for (size_t i = first; i < history.points.size(); ++i) {
        const HistoryPoint& point = history.points[i];
        const SideMeasure& port = point.totals.found.target.measure;
        out += fmt::format("{}  {}  {:>6}/{:<7} {:>6}  {:<21}  {:>4} of {:<4} {:>16.1f}\n", day_of(point.commit.time),
                           short_id(point.commit.id), shared_text(point.totals, Side::Target, "-"), port.lines,
                           percent_text(port.moss_percent), figure_text(point.totals.degree), point.open_pairs,
                           point.pairs, point.debt);
    }
    const HistoryPoint& newest = history.points.back();
    out += "blocks at the newest commit:\n";
    for (const MeasuredBlock& block : newest.blocks)
        out += fmt::format("  {:>6}/{:<7} {:>6}  {:<21}  {}\n", shared_text(block, Side::Target, "-"),
                           block.found.target.measure.lines, percent_text(block.found.target.measure.moss_percent),
                           figure_text(block.degree), terminal_text(block.name));
    for (const OpenPair& pair : history.open)
        out += fmt::format("open since {}: {}  =  {}, {} lines, {:.1f} line-days\n", day_of(pair.since),
                           terminal_text(pair.id.first), terminal_text(pair.id.second), pair.lines,
                           pair.debt(newest.commit.time));
    return out;
}

}  // namespace porttool

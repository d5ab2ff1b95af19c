// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The page of history --format html: plain SVG and CSS, nothing from elsewhere, no script.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "porttool/report/chart.h"
#include "porttool/report/figures.h"
#include "porttool/report/history_report.h"
#include "porttool/report/page.h"
#include "porttool/text/date.h"
#include "porttool/text/sink/html.h"

namespace porttool {
namespace {

constexpr size_t kMostLines = 6;  // of blocks in one chart; more cannot be told apart

/// The days at both ends, and the times where all that is shown happened within two days.
TimeAxis axis_of(const std::vector<HistoryPoint>& points) {
    constexpr int64_t kTwoDays = 2 * 86400, kDay = 86400, kHour = 3600, kMinute = 60;
    TimeAxis axis;
    for (const HistoryPoint& point : points) axis.times.push_back(point.commit.time);
    const bool days = axis.times.back() - axis.times.front() > kTwoDays;
    const auto label = [&](int64_t time) {
        return days ? day_of(time)
                    : fmt::format("{} {:02}:{:02} UTC", day_of(time), time % kDay / kHour, time % kHour / kMinute);
    };
    axis.first_label = label(axis.times.front());
    axis.last_label = label(axis.times.back());
    return axis;
}

/// The largest blocks of the newest commit.
std::vector<std::string> chosen_blocks(const HistoryPoint& newest) {
    std::vector<const MeasuredBlock*> blocks;
    for (const MeasuredBlock& block : newest.blocks) blocks.push_back(&block);
    std::stable_sort(blocks.begin(), blocks.end(), [](const MeasuredBlock* a, const MeasuredBlock* b) {
        return a->found.target.measure.lines > b->found.target.measure.lines;
    });
    std::vector<std::string> names;
    for (const MeasuredBlock* block : blocks)
        if (names.size() < kMostLines) names.push_back(block->name);
    return names;
}

using Value = std::optional<double> (*)(const MeasuredBlock&);

std::vector<Series> block_series(const History& history, Value value) {
    constexpr std::array<const char*, kMostLines + 1> kDashes = {"none",     "none", "7 3", "2 3",
                                                                 "10 3 2 3", "4 4",  "12 4"};
    std::vector<Series> out(1);
    out[0] = {"all", "--c0", "1 5", {}, {}};
    for (const std::string& name : chosen_blocks(history.points.back()))
        out.push_back({name, "--c" + std::to_string(out.size()), kDashes[out.size()], {}, {}});
    for (const HistoryPoint& point : history.points) {
        out[0].values.push_back(value(point.totals));
        for (size_t i = 1; i < out.size(); ++i) {
            const auto block = std::find_if(point.blocks.begin(), point.blocks.end(),
                                            [&](const MeasuredBlock& one) { return one.name == out[i].name; });
            out[i].values.push_back(block == point.blocks.end() ? std::nullopt : value(*block));
        }
    }
    return out;
}

/// The least round number that no value exceeds.
double round_up(double value) {
    double step = 1;
    while (step < value) step *= 10;
    for (const double part : {0.2, 0.4, 0.5, 0.8})
        if (step * part >= value) return step * part;
    return step;
}

Chart degree_chart(const History& history) {
    const auto degree = [](const MeasuredBlock& block) -> std::optional<double> {
        return block.degree ? std::optional<double>(block.degree->value) : std::nullopt;
    };
    Chart chart{
        "Degree of portability",
        "1 - novel lines / lines of the port: 1 where the source has every line of the port, 0 where it has none.",
        0,
        1,
        "",
        block_series(history, degree)};
    for (const Series& series : chart.series)
        for (const auto& value : series.values)
            if (value && *value < chart.low) chart.low = std::floor(*value);
    return chart;
}

Chart similarity_chart(const History& history) {
    return {"Similarity of the port",
            "Moss percent: the share of the port's tokens in runs that the source has, too. It is no degree of "
            "portability.",
            0,
            100,
            " %",
            block_series(history, [](const MeasuredBlock& block) { return block.found.target.measure.moss_percent; })};
}

Chart debt_chart(const History& history) {
    Chart chart{"Drift debt",
                "Line-days: for each pair that one side has left, the lines that wait times the days that they have "
                "waited; before "
                "and after each commit.",
                0,
                1,
                " line-days",
                {{"drift debt", "--debt", "none", {}, {}}}};
    chart.filled = true;
    double most = 0;
    for (const HistoryPoint& point : history.points) {
        chart.series[0].values.emplace_back(point.debt);
        chart.series[0].before.push_back(point.debt_before);
        most = std::max({most, point.debt, point.debt_before});
    }
    chart.high = round_up(std::max(1.0, most));
    return chart;
}

/// Whether the blocks that change most are the ones that are alike.
std::string sentence_on_churn(const History& history) {
    const std::string what = "Touched: commits shown, after the first, that changed a file of the block. ";
    if (!history.churn_and_likeness)
        return "<p>" + what + "Too few blocks to say whether those that change most are the similar ones.</p>\n";
    return "<p>" + what +
           fmt::format(
               "Whether those that change most for their size are the similar ones: rank correlation {:.2f} of commits "
               "per line and Moss % (1: they are, -1: the stable ones are, 0: neither).</p>\n",
               *history.churn_and_likeness);
}

std::string table_of_blocks(const History& history) {
    const HistoryPoint& newest = history.points.back();
    std::string out =
        "<h2>Blocks at the newest commit</h2>\n<div class=\"scroll\" tabindex=\"0\"><table><thead><tr><th "
        "scope=\"col\">block</th>"
        "<th scope=\"col\">source lines</th><th scope=\"col\">shared</th><th scope=\"col\">port lines</th>"
        "<th scope=\"col\">shared</th><th scope=\"col\">Moss % of the port</th><th scope=\"col\">degree of "
        "portability</th><th scope=\"col\">touched</th></tr></thead><tbody>\n";
    const auto shared = [](const MeasuredBlock& block, Side side) {
        return block.is_too_short() ? std::string("too short") : std::to_string(block.found[side].measure.shared_lines);
    };
    const auto row = [&](const MeasuredBlock& block, const std::string& name, const std::string& touched) {
        out += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            html_text(name), block.found.source.measure.lines, shared(block, Side::Source),
            block.found.target.measure.lines, shared(block, Side::Target),
            block.found.target.measure.moss_percent ? bounded_text(*block.found.target.measure.moss_percent, 100, 1)
                                                    : "-",
            figure_text(block.degree), touched);
    };
    for (size_t i = 0; i < newest.blocks.size(); ++i)
        row(newest.blocks[i], newest.blocks[i].name, std::to_string(history.churn.at(i).commits));
    row(newest.totals, "all", "");
    return out + "</tbody></table></div>\n" + sentence_on_churn(history);
}

std::string table_of_open(const History& history) {
    if (history.open.empty()) return "<h2>Open pairs</h2>\n<p>None: every pair is in step.</p>\n";
    std::string out =
        "<h2>Open pairs</h2>\n<div class=\"scroll\" tabindex=\"0\"><table><thead><tr><th scope=\"col\">pair</th><th "
        "scope=\"col\">open "
        "since</th><th scope=\"col\">lines</th><th scope=\"col\">line-days</th></tr></thead><tbody>\n";
    const int64_t now = history.points.back().commit.time;
    std::vector<OpenPair> pairs = history.open;
    std::stable_sort(pairs.begin(), pairs.end(),
                     [&](const OpenPair& a, const OpenPair& b) { return a.debt(now) > b.debt(now); });
    for (const OpenPair& pair : pairs)
        out += fmt::format("<tr><td>{} = {}</td><td>{}</td><td>{}</td><td>{:.1f}</td></tr>\n", html_text(pair.id.first),
                           html_text(pair.id.second), day_of(pair.since), pair.lines, pair.debt(now));
    return out + "</tbody></table></div>\n";
}

}  // namespace

std::string history_html(const History& history) {
    std::string body = fmt::format(
        "<p>{} commits read, from {} on{}; {} are shown: those that touch the two sides or their map, and the "
        "newest.</p>\n",
        history.commits, day_of(history.oldest.time), history.cut ? ", as far as this shallow clone reaches" : "",
        history.points.size());
    if (!history.points.empty()) {
        const HistoryPoint& newest = history.points.back();
        body += fmt::format(
            "<p>At the newest commit, {} of {}: {} of {} pairs are open, {:.1f} line-days of drift.</p>\n",
            short_id(newest.commit.id), day_of(newest.commit.time), newest.open_pairs, newest.pairs, newest.debt);
        const TimeAxis axis = axis_of(history.points);
        for (const Chart& chart : {degree_chart(history), similarity_chart(history), debt_chart(history)})
            body += figure_of(chart, axis);
        body += table_of_blocks(history) + table_of_open(history);
    }
    return filled_page("history.html", {{"@STYLE@", page_file("history.css")}, {"@BODY@", body}});
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The page of history --format html: plain SVG and CSS, nothing from elsewhere, no script.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "porttool/report/figures.h"
#include "porttool/report/history_report.h"
#include "porttool/text/date.h"
#include "porttool/text/sink/html.h"

namespace porttool {
namespace {

constexpr double kWidth = 960, kHeight = 300, kLeft = 76, kRight = 16, kTop = 14, kBottom = 34;
constexpr size_t kMostLines = 6;  // of blocks in one chart; more cannot be told apart

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ground: #fbfaf7; --panel: #fff; --line: #e3e0d8; --ink: #1d2126; --muted: #5d636b;
  --c0: #1d2126; --c1: #12767a; --c2: #a8553c; --c3: #46609f; --c4: #8a5a96; --c5: #7c7a25; --c6: #3f7f4c; --debt: #b3261e; }
@media (prefers-color-scheme: dark) { :root { --ground: #14171b; --panel: #1b1f24; --line: #2d333b; --ink: #e9e6df;
  --muted: #a1a8b1; --c0: #e9e6df; --c1: #45b5b2; --c2: #e39178; --c3: #8aa4e6; --c4: #c894d6; --c5: #c4c160;
  --c6: #7cc98c; --debt: #ff8a80; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 66rem; padding: 2rem 1rem 4rem; background: var(--ground); color: var(--ink);
  font: 1rem/1.5 system-ui, sans-serif; }
h1 { font-size: 1.6rem; margin: 0 0 .3rem; } h2 { font-size: 1.15rem; margin: 2.2rem 0 .4rem; }
p { max-width: 68ch; margin: .3rem 0; } .fine { color: var(--muted); font-size: .9rem; }
figure { margin: .8rem 0 0; background: var(--panel); border: 1px solid var(--line); border-radius: 10px; padding: .8rem; }
svg { display: block; width: 100%; height: auto; overflow: visible; } svg text { fill: var(--muted); font: 12px system-ui, sans-serif; }
.grid { stroke: var(--line); } .series { fill: none; stroke-width: 2; stroke-linejoin: round; }
.legend { display: flex; flex-wrap: wrap; gap: .2rem 1.2rem; list-style: none; margin: .6rem 0 0; padding: 0; font-size: .9rem; }
.legend li { overflow-wrap: anywhere; } .legend svg { display: inline-block; width: 28px; height: 10px; margin-right: .4rem; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-size: .9rem; width: 100%; }
th, td { text-align: right; padding: .25rem .6rem; border-bottom: 1px solid var(--line); font-variant-numeric: tabular-nums; white-space: nowrap; }
th { color: var(--muted); font-weight: 500; } th:first-child, td:first-child { text-align: left; min-width: 11rem; white-space: normal; overflow-wrap: anywhere; }
@media (max-width: 40rem) { svg text { font-size: 24px; } .series { stroke-width: 3.5; } .legend .series { stroke-width: 2; } }
@media print { body { max-width: none; } figure { break-inside: avoid; } }
)";

/// A number short enough for an axis, without an exponent.
std::string number_text(double value) {
    constexpr double kThousand = 1000;
    return std::abs(value) >= kThousand ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

/// The day, and the time where all that is shown happened within two days.
std::string moment_text(int64_t time, const History& history) {
    constexpr int64_t kTwoDays = 2 * 86400, kDay = 86400, kHour = 3600, kMinute = 60;
    if (history.points.back().commit.time - history.points.front().commit.time > kTwoDays) return day_of(time);
    return fmt::format("{} {:02}:{:02} UTC", day_of(time), time % kDay / kHour, time % kHour / kMinute);
}

struct Series {
    std::string name, color, dash;
    std::vector<std::optional<double>> values;  ///< one a point
    std::vector<double> before;                 ///< values an instant earlier, where they jump; else empty
};

struct Chart {
    std::string title, description;
    double low = 0, high = 1;
    std::string unit;
    std::vector<Series> series;
    bool filled = false;
};

/// Places of the points from left to right: by time, or by number where all have one time.
std::vector<double> places(const std::vector<HistoryPoint>& points) {
    std::vector<double> out;
    const auto first = static_cast<double>(points.front().commit.time);
    double span = 0;
    for (const HistoryPoint& point : points) span = std::max(span, static_cast<double>(point.commit.time) - first);
    for (size_t i = 0; i < points.size(); ++i) {
        const double part = span > 0
                                ? (static_cast<double>(points[i].commit.time) - first) / span
                                : static_cast<double>(i) / static_cast<double>(std::max<size_t>(1, points.size() - 1));
        out.push_back(kLeft + std::clamp(part, 0.0, 1.0) * (kWidth - kLeft - kRight));
    }
    return out;
}

double height_of(const Chart& chart, double value) {
    const double part = (value - chart.low) / (chart.high - chart.low);
    return kHeight - kBottom - std::clamp(part, 0.0, 1.0) * (kHeight - kTop - kBottom);
}

std::string path_of(const Chart& chart, const Series& series, const std::vector<double>& x) {
    std::string path;
    bool drawing = false;
    for (size_t i = 0; i < series.values.size(); ++i) {
        if (!series.values[i]) {
            drawing = false;
            continue;
        }
        const auto go_to = [&](double value) {
            path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", x[i], height_of(chart, value));
            drawing = true;
        };
        if (!series.before.empty() && series.before[i] != *series.values[i]) go_to(series.before[i]);
        go_to(*series.values[i]);
    }
    return path;
}

std::string grid_of(const Chart& chart, const History& history) {
    std::string out;
    constexpr int kSteps = 4;
    for (int i = 0; i <= kSteps; ++i) {
        const double value = chart.low + (chart.high - chart.low) * i / kSteps, y = height_of(chart, value);
        out += fmt::format(
            "<line class=\"grid\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/><text x=\"{}\" "
            "y=\"{:.1f}\" text-anchor=\"end\">{}</text>",
            kLeft, kWidth - kRight, y, y, kLeft - 8, y + 4, number_text(value));
    }
    out += fmt::format("<text x=\"{}\" y=\"{}\">{}</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>", kLeft,
                       kHeight - 10, moment_text(history.points.front().commit.time, history), kWidth - kRight,
                       kHeight - 10, moment_text(history.points.back().commit.time, history));
    return out;
}

std::string figure_of(const Chart& chart, const History& history) {
    const std::vector<double> x = places(history.points);
    std::string out = fmt::format(
        "<h2>{}</h2>\n<p class=\"fine\">{}</p>\n<figure><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">"
        "<title>{}</title><desc>{}</desc>{}\n",
        html_text(chart.title), html_text(chart.description), kWidth, kHeight, html_text(chart.title),
        html_text(chart.title), html_text(chart.description), grid_of(chart, history));
    std::string legend, above;
    for (const Series& series : chart.series) {
        const std::string path = path_of(chart, series, x);
        if (chart.filled && !path.empty())
            out += fmt::format("<path d=\"{}L{:.1f} {:.1f}L{:.1f} {:.1f}Z\" fill=\"var({})\" opacity=\".18\"/>", path,
                               x.back(), height_of(chart, chart.low), x.front(), height_of(chart, chart.low),
                               series.color);
        // The first lies above the others: where they are one line, its dashes show.
        std::string& layer = &series == &chart.series.front() ? above : out;
        layer += fmt::format("<path class=\"series\" d=\"{}\" stroke=\"var({})\" stroke-dasharray=\"{}\"/>", path,
                             series.color, series.dash);
        if (!series.values.empty() && series.values.back())
            out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"var({})\"/>\n", x.back(),
                               height_of(chart, *series.values.back()), series.color);
        legend += fmt::format(
            "<li><svg viewBox=\"0 0 28 10\" aria-hidden=\"true\"><path class=\"series\" d=\"M0 5H28\" "
            "stroke=\"var({})\" stroke-dasharray=\"{}\"/></svg>{}{}</li>",
            series.color, series.dash, html_text(series.name),
            series.values.empty() || !series.values.back() ? std::string()
                                                           : ": " + number_text(*series.values.back()) + chart.unit);
    }
    return out + above + "</svg><ul class=\"legend\">" + legend + "</ul></figure>\n";
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

std::string table_of_blocks(const HistoryPoint& newest) {
    std::string out =
        "<h2>Blocks at the newest commit</h2>\n<div class=\"scroll\" tabindex=\"0\"><table><thead><tr><th "
        "scope=\"col\">block</th>"
        "<th scope=\"col\">source lines</th><th scope=\"col\">shared</th><th scope=\"col\">port lines</th>"
        "<th scope=\"col\">shared</th><th scope=\"col\">Moss % of the port</th><th scope=\"col\">degree of "
        "portability</th></tr></thead><tbody>\n";
    const auto shared = [](const MeasuredBlock& block, Side side) {
        return block.is_too_short() ? std::string("too short") : std::to_string(block.found[side].measure.shared_lines);
    };
    const auto row = [&](const MeasuredBlock& block, const std::string& name) {
        out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                           html_text(name), block.found.source.measure.lines, shared(block, Side::Source),
                           block.found.target.measure.lines, shared(block, Side::Target),
                           block.found.target.measure.moss_percent
                               ? bounded_text(*block.found.target.measure.moss_percent, 100, 1)
                               : "-",
                           figure_text(block.degree));
    };
    for (const MeasuredBlock& block : newest.blocks) row(block, block.name);
    row(newest.totals, "all");
    return out + "</tbody></table></div>\n";
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
    std::string out =
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>History of a port</title><style>" +
        std::string(kStyle) + "</style></head><body>\n<main>\n<h1>History of a port</h1>\n";
    out += fmt::format(
        "<p>{} commits read, from {} on{}; {} are shown: those that touch the two sides or their map, and the "
        "newest.</p>\n",
        history.commits, day_of(history.oldest.time), history.cut ? ", as far as this shallow clone reaches" : "",
        history.points.size());
    if (!history.points.empty()) {
        const HistoryPoint& newest = history.points.back();
        out += fmt::format(
            "<p>At the newest commit, {} of {}: {} of {} pairs are open, {:.1f} line-days of drift.</p>\n",
            newest.commit.id.substr(0, 10), day_of(newest.commit.time), newest.open_pairs, newest.pairs, newest.debt);
        for (const Chart& chart : {degree_chart(history), similarity_chart(history), debt_chart(history)})
            out += figure_of(chart, history);
        out += table_of_blocks(newest) + table_of_open(history);
    }
    return out + "</main></body></html>\n";
}

}  // namespace porttool

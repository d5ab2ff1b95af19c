// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/compare_report.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "metrics/code/string_tiling.h"
#include "porttool/report/figures.h"
#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json range(const ExcerptLines& lines) { return Json::array({lines.first, lines.last}); }

/// Never rounded up to `most` or down to 0: those say that nothing differs, or nothing agrees.
std::string figure(const std::optional<double>& value, double most, int digits) {
    return value ? bounded_text(*value, most, digits) : "-";
}

std::string percent(const std::optional<double>& value) {
    constexpr double kMost = 100;
    return figure(value, kMost, 1);
}

std::string row(const std::string& name, const std::string& a, const std::string& b) {
    return fmt::format("{:<30}{:>10}{:>10}\n", name, a, b);
}

std::string row(const std::string& name, const std::optional<double>& both) {
    constexpr int kDigits = 3;
    return fmt::format("{:<30}{:>10}\n", name, figure(both, 1, kDigits));
}

}  // namespace

std::string compare_json(const CompareReport& report) {
    const Similarity& s = report.similarity;
    Json matches = Json::array();
    for (const LineMatch& match : s.matches) matches.push_back({{"a", range(match.a)}, {"b", range(match.b)}});
    const Json out = {
        {"a", {{"id", report.a_id}, {"file", report.a_file}, {"lines", s.a.lines}, {"tokens", s.a.tokens}}},
        {"b", {{"id", report.b_id}, {"file", report.b_file}, {"lines", s.b.lines}, {"tokens", s.b.tokens}}},
        {"shared_lines_a", s.a.moss_percent ? Json(s.a.shared_lines) : Json(nullptr)},
        {"shared_lines_b", s.b.moss_percent ? Json(s.b.shared_lines) : Json(nullptr)},
        {"moss_percent_a", or_null(s.a.moss_percent)},
        {"moss_percent_b", or_null(s.b.moss_percent)},
        {"moss_percent_blind_a", or_null(s.a.moss_percent_blind)},
        {"moss_percent_blind_b", or_null(s.b.moss_percent_blind)},
        {"moss_percent_raw_a", or_null(s.a.moss_percent_raw)},
        {"moss_percent_raw_b", or_null(s.b.moss_percent_raw)},
        {"tiling", or_null(s.tiling)},
        {"token_edit", or_null(s.token_edit)},
        {"tree_distance", or_null(s.tree_distance)},
        {"line_divergence", or_null(s.line_divergence)},
        {"unmeasured", s.unmeasured},
        {"parameters",
         {{"k", report.parameters.k},
          {"w", report.parameters.w},
          {"guarantee", report.parameters.guarantee()},
          {"tiling_minimum", metrics::TilingParameters{}.minimum}}},
        {"matches", matches}};
    return json_text(out, 1) + "\n";
}

std::string compare_table(const CompareReport& report) {
    const Similarity& s = report.similarity;
    std::string out = fmt::format("a: {}\nb: {}\n\n", terminal_text(report.a_id), terminal_text(report.b_id));
    out += row("", "a", "b");
    out += row("lines with code", std::to_string(s.a.lines), std::to_string(s.b.lines));
    out += row("tokens", std::to_string(s.a.tokens), std::to_string(s.b.tokens));
    if (s.a.moss_percent)
        out += row("shared lines", std::to_string(s.a.shared_lines), std::to_string(s.b.shared_lines));
    else
        out += row("shared lines", "-", "-");
    out += row("Moss %, dialect", percent(s.a.moss_percent), percent(s.b.moss_percent));
    out += row("Moss %, blind", percent(s.a.moss_percent_blind), percent(s.b.moss_percent_blind));
    out += row("Moss %, raw", percent(s.a.moss_percent_raw), percent(s.b.moss_percent_raw));
    out += row("tiling (1 is alike)", s.tiling);
    out += row("token edit (1 is alike)", s.token_edit);
    out += row("tree distance (0 is alike)", s.tree_distance);
    out += row("line divergence (0 is alike)", s.line_divergence);
    std::map<std::string, std::string> names;  // of the figures that one reason left out
    for (const auto& [name, reason] : s.unmeasured) names[reason] += (names[reason].empty() ? "" : ", ") + name;
    for (const auto& [reason, figures] : names) out += fmt::format("{} ({})\n", reason, figures);
    out += fmt::format("\nk = {} tokens, w = {}: each run of {} tokens that both sides have is found; tiles of {}\n",
                       report.parameters.k, report.parameters.w, report.parameters.guarantee(),
                       metrics::TilingParameters{}.minimum);
    return out;
}

}  // namespace porttool

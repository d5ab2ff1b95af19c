// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/check_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "porttool/text/utf8.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;

ordered_json place_json(const std::optional<Place>& place) {
    if (!place) return nullptr;
    return {{"id", place->id}, {"file", place->file}, {"line", place->line}, {"end_line", place->end_line}};
}

bool is_shown(const Finding& finding) { return finding.level != Level::Off && finding.verdict.empty(); }

const char* color_of(Level level) {
    return level == Level::Error ? "\x1b[31m" : level == Level::Warning ? "\x1b[33m" : "\x1b[36m";
}

}  // namespace

Finding printable(const Finding& finding) {
    Finding out = finding;
    for (std::string* text : {&out.message, &out.remedy, &out.map_source, &out.map_target, &out.verdict_reason})
        *text = as_printable(*text);
    for (std::string& detail : out.details) detail = as_printable(detail);
    for (std::optional<Place>* place : {&out.source, &out.target})
        if (*place) {
            (*place)->id = as_printable((*place)->id);
            (*place)->file = as_printable((*place)->file);
        }
    return out;
}

std::string check_json(const Judgement& judgement) {
    const Summary& s = judgement.summary;
    ordered_json findings = ordered_json::array();
    for (const Finding& f : judgement.findings) {
        if (!is_shown(f)) continue;
        ordered_json one = {{"rule", f.rule},
                            {"level", level_name(f.level)},
                            {"change", f.change.empty() ? ordered_json(nullptr) : ordered_json(f.change)},
                            {"source", place_json(f.source)},
                            {"target", place_json(f.target)},
                            {"message", f.message},
                            {"remedy", f.remedy},
                            {"fingerprint", f.fingerprint}};
        if (!f.source && !f.target) one["map_line"] = f.map_line;  // in portmap.toml
        if (!f.details.empty()) one["details"] = f.details;
        findings.push_back(std::move(one));
    }
    const ordered_json out = {{"verdict", judgement.verdict()},
                              {"summary",
                               {{"pairs", s.pairs},
                                {"in_step", s.in_step},
                                {"drifted", s.drifted},
                                {"review", s.review},
                                {"unported", s.unported},
                                {"deferred", s.deferred},
                                {"ignored", s.ignored}}},
                              {"findings", findings}};
    return out.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string check_table(const Judgement& judgement, bool color) {
    std::string out;
    for (const Finding& finding : judgement.findings) {
        if (!is_shown(finding)) continue;
        const Finding f = printable(finding);
        const Place place = f.source ? *f.source : f.target.value_or(Place{"", "portmap.toml", f.map_line, f.map_line});
        const std::string level = color ? fmt::format("{}{}\x1b[0m", color_of(f.level), level_name(f.level))
                                        : std::string(level_name(f.level));
        out += fmt::format("{}:{}: {}: {} [{}]\n", place.file, place.line, level, f.message, f.rule);
        if (f.source && f.target) out += fmt::format("    port: {}:{}\n", f.target->file, f.target->line);
        if (f.details.size() > 1)
            for (const std::string& detail : f.details) out += "    " + detail + "\n";
        out += "    " + f.remedy + "\n";
    }
    const Summary& s = judgement.summary;
    out += fmt::format(
        "{}: {} pairs, {} in step, {} drifted, {} to review, {} deferred, {} ignored; {} source units without a port\n",
        judgement.verdict(), s.pairs, s.in_step, s.drifted, s.review, s.deferred, s.ignored, s.unported);
    return out;
}

}  // namespace porttool

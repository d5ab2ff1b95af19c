// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/lsp/diagnostics.h"

#include <charconv>

namespace porttool::lsp {
namespace {

int severity_of(Level level) {
    constexpr int kError = 1, kWarning = 2, kInformation = 3;
    return level == Level::Error ? kError : level == Level::Warning ? kWarning : kInformation;
}

/// Where one side of a finding is shown.
struct ShownPlace {
    std::string path;
    Range range;
};

ShownPlace shown_place(const CheckedProject& project, const ProjectPlaces& places, const Place& place) {
    const std::string path = absolute_path(join_path(project.project.root, place.file));
    return {path, places.range_of(path, place.id, place.line)};
}

Range whole_line(uint32_t line) {
    const uint32_t row = line == 0 ? 0 : line - 1;
    return {{row, 0}, {row + 1, 0}};
}

Json diagnostic(const Finding& finding, const Range& range) {
    std::string message = finding.message;
    if (finding.details.size() > 1)
        for (const std::string& detail : finding.details) message += "\n" + detail;
    return {{"range", range_json(range)},
            {"severity", severity_of(finding.level)},
            {"code", rule_name(finding.rule)},
            {"source", "porttool"},
            {"message", message + "\n" + finding.remedy},
            {"data", {{"fingerprint", finding.fingerprint}}}};
}

}  // namespace

std::map<std::string, Json> diagnostics_of(const CheckedProject& project, const ProjectPlaces& places,
                                           const UriOf& uri_of) {
    std::map<std::string, Json> out;
    for (const Finding& finding : project.judgement.findings) {
        if (!is_open(finding)) continue;
        BySide<std::optional<ShownPlace>> shown;
        if (finding.source) shown.source = shown_place(project, places, *finding.source);
        if (finding.target) shown.target = shown_place(project, places, *finding.target);
        if (!shown.source && !shown.target)
            out[project.project.map_path].push_back(diagnostic(finding, whole_line(finding.map_line)));
        for (const Side side : kBothSides) {
            if (!shown[side]) continue;
            Json one = diagnostic(finding, shown[side]->range);
            if (const auto& there = shown[other(side)])
                one["relatedInformation"] = {{{"location", location_json(uri_of(there->path), there->range)},
                                              {"message", side == Side::Source ? "its port" : "its source"}}};
            out[shown[side]->path].push_back(std::move(one));
        }
    }
    return out;
}

Json diagnostic_of_error(const std::string& message, const std::string& map_name) {
    uint32_t line = 1;
    if (message.starts_with(map_name + ":"))
        (void)std::from_chars(message.data() + map_name.size() + 1, message.data() + message.size(), line);
    return {{"range", range_json(whole_line(line))},
            {"severity", severity_of(Level::Error)},
            {"source", "porttool"},
            {"message", message}};
}

}  // namespace porttool::lsp

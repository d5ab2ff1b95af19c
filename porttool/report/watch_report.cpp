// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/watch_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "porttool/report/check_report.h"
#include "porttool/report/figures.h"
#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// One value on a line of its own.
std::string json_line(const nlohmann::ordered_json& value) { return json_text(value, -1) + "\n"; }

/// The id that a person knows the subject of a finding by.
std::string subject_of(const Finding& finding) {
    if (!finding.map_source.empty()) return finding.map_source;
    return finding.source ? finding.source->id : finding.target ? finding.target->id : finding.fingerprint;
}

}  // namespace

std::string watch_text(const WatchStep& step, bool color) {
    if (step.changes.empty()) return {};
    std::string out;
    for (const Finding* finding : step.changes.fresh) out += finding_text(*finding, color);
    for (const Finding* finding : step.changes.gone)
        out += fmt::format("settled: {} [{}]\n", terminal_text(subject_of(*finding)), rule_name(finding->rule));
    return out + summary_text(step.now);
}

std::string watch_json(const WatchStep& step) {
    std::string out;
    for (const Finding* finding : step.changes.fresh) {
        nlohmann::ordered_json line = {{"t_ms", step.t_ms}, {"event", "finding"}};
        line.update(finding_json(*finding));
        out += json_line(line);
    }
    for (const Finding* finding : step.changes.gone)
        out += json_line({{"t_ms", step.t_ms},
                          {"event", "gone"},
                          {"rule", rule_name(finding->rule)},
                          {"fingerprint", finding->fingerprint}});
    constexpr double kTenths = 10;
    return out + json_line({{"t_ms", step.t_ms},
                            {"event", "judged"},
                            {"verdict", gate_result_name(step.now.result())},
                            {"summary", summary_json(step.now.summary)},
                            {"files", step.files},
                            {"look_ms", std::round(step.look_ms * kTenths) / kTenths}});
}

std::string watch_error_json(const std::string& message, int64_t t_ms) {
    return json_line({{"t_ms", t_ms}, {"event", "error"}, {"message", message}});
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/map_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

std::string_view state_name(PairState state) { return state == PairState::Confirmed ? "confirmed" : "suggested"; }

}  // namespace

std::string map_json(const Matching& matching) {
    nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
    for (const MatchedPair& pair : matching.pairs)
        pairs.push_back({{"source", pair.source},
                         {"target", pair.target},
                         {"score", std::round(static_cast<double>(pair.score) * 1000) / 1000},
                         {"state", state_name(pair.state)}});
    const nlohmann::ordered_json out = {{"pairs", pairs},
                                        {"unmapped_source", matching.unmapped_source},
                                        {"unmapped_target", matching.unmapped_target},
                                        {"ports", matching.ports}};
    return json_text(out, 1) + "\n";
}

std::string map_table(const Matching& matching) {
    std::string out;
    for (const MatchedPair& pair : matching.pairs)
        out += fmt::format("{:<9} {:>3.0f} %  {}  =  {}\n", state_name(pair.state), 100 * pair.score,
                           terminal_text(pair.source), terminal_text(pair.target));
    for (const std::string& id : matching.unmapped_source)
        out += fmt::format("no port          {}\n", terminal_text(id));
    for (const std::string& id : matching.unmapped_target)
        out += fmt::format("no source        {}\n", terminal_text(id));
    out += ports_line(matching);
    return out + fmt::format("{} pairs, {} source units without a port, {} target units without a source\n",
                             matching.pairs.size(), matching.unmapped_source.size(), matching.unmapped_target.size());
}

std::string ports_line(const Matching& matching) {
    if (matching.ports.empty()) return {};
    std::string names;
    for (const std::string& name : matching.ports) names += (names.empty() ? "" : ", ") + terminal_text(name);
    return fmt::format(
        "{} ports lie side by side, each is paired for itself: {}. Named in [sides.targets], each is asked for new "
        "units as well\n",
        matching.ports.size(), names);
}

}  // namespace porttool

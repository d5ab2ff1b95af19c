// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/ledger.h"

#include <cmath>
#include <map>
#include <utility>

#include "metrics/portability/port_fit.h"
#include "metrics/portability/power_law.h"

namespace porttool {
namespace {

bool names(const Past& past, const std::string& revision, const GitCommit& commit) {
    if (revision.empty()) return false;
    const auto found = past.git->commit(revision);
    return found && found->id == commit.id;
}

/// Degrees of portability from the hours of port and redevelopment: of this change, of all entries and by block.
void add_degrees(const Past& past, const std::vector<MapEffort>& ledger, RangeEffort& range) {
    std::vector<metrics::RecordedCost> all, own;
    std::map<std::string, std::vector<metrics::RecordedCost>> blocks;
    for (const MapEffort& entry : ledger) {
        if (!entry.port || !entry.redevelopment) continue;
        all.push_back({*entry.port, *entry.redevelopment, entry.uncertainty});
        if (!entry.block.empty()) blocks[entry.block].push_back(all.back());
        if (names(past, entry.from, range.from) && names(past, entry.to, range.to)) own.push_back(all.back());
    }
    if (const auto degree = metrics::degree_from_hours(own))
        range.degrees.push_back(*degree);
    else
        range.missing.emplace_back(
            "hours: no [[effort]] in portmap.toml has these two commits with hours of port and "
            "redevelopment; porttool effort --format toml writes its lines");
    range.ledger_degree = metrics::degree_from_hours(all);
    for (const auto& [block, records] : blocks)
        if (const auto degree = metrics::degree_from_hours(records)) range.ledger_blocks.emplace_back(block, *degree);
}

/// The hours of this port as the project's own recorded ones predict them, and the degree that follows.
void add_prediction(const std::vector<MapEffort>& ledger, RangeEffort& range) {
    std::vector<metrics::RecordedPort> ports;
    double anew_hours = 0, anew_lines = 0;
    for (const MapEffort& entry : ledger) {
        if (entry.mined) continue;  // other people's hours, by other means
        if (entry.port && entry.lines && entry.novel)
            ports.push_back({*entry.novel, *entry.lines - *entry.novel, entry.port->total()});
        if (entry.redevelopment && entry.lines) {
            anew_hours += entry.redevelopment->total();
            anew_lines += *entry.lines;
        }
    }
    const metrics::PortFit fit = metrics::fit_ports(ports);
    if (!fit.fit) {
        range.missing.push_back("hours, linear in lines: " + fit.refusal);
        return;
    }
    const PortedEdit& totals = range.effort.totals;
    range.hours = metrics::predicted_hours(fit, static_cast<double>(totals.novel()), totals.carried.shared);
    const double rate = anew_lines > 0 ? anew_hours / anew_lines : 0;
    if (const auto degree = metrics::degree_from_prediction(*range.hours, rate * totals.carried.lines))
        range.degrees.push_back(*degree);
}

/// Ports whose hours lie a hundred powers of ten apart have a law that gives no number.
void add_hours_by_law(metrics::Figure hours, RangeEffort& range) {
    if (std::isfinite(hours.value) && std::isfinite(hours.high))
        range.hours_by_law = std::move(hours);
    else
        range.missing.emplace_back(
            "Hakuta and Ohminami, equation 8: the recorded ports give no number of hours here; "
            "look at their hours and impediments");
}

/// The same by Hakuta and Ohminami's equation, from lines and impediments.
void add_power_law(const MapFile& map, RangeEffort& range) {
    std::vector<metrics::SizedPort> ports;
    for (const MapEffort& entry : map.efforts)
        if (entry.port && entry.lines)
            ports.push_back({*entry.lines, entry.impediments, entry.port->total(), entry.mined});
    const metrics::PowerLaw law = metrics::fit_power_law(ports);
    const double lines = range.effort.totals.carried.lines;
    if (!law.fit)
        range.missing.push_back("Hakuta and Ohminami, equation 8: " + law.refusal);
    else if (lines > 0)
        add_hours_by_law(metrics::predicted_hours(law, lines, map.impediments), range);
}

}  // namespace

void add_ledger(const Past& past, const MapFile& map, RangeEffort& range) {
    add_degrees(past, map.efforts, range);
    add_prediction(map.efforts, range);
    add_power_law(map, range);
}

}  // namespace porttool

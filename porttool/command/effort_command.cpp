// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "metrics/portability/port_fit.h"
#include "metrics/portability/reuse.h"
#include "porttool/command/commands.h"
#include "porttool/read/source_files.h"
#include "porttool/report/effort_report.h"
#include "porttool/scan/scan.h"
#include "porttool/snapshot/past.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// The map at a commit, if it has one.
std::optional<MapFile> map_at(const Past& past, const GitCommit& commit) {
    const auto found = past.git->changes("", commit.id, [](const std::string& path) { return path == "portmap.toml"; });
    if (found.empty()) return std::nullopt;
    ReadMap read = read_map("portmap.toml at " + commit.id, read_blob(past, "portmap.toml", found.front().blob));
    if (!read.error.empty()) throw CannotDo(read.error);
    return std::move(read.map);
}

/// The map that names the pairs: the given one, else that of the newer commit, of the older, of today.
MapFile map_for(const Past& past, const GitCommit& from, const GitCommit& to) {
    if (past.map_is_given) return past.map_today;
    if (auto map = map_at(past, to)) return *map;
    if (auto map = map_at(past, from)) return *map;
    if (past.has_map_today) return past.map_today;
    throw CannotDo("there is no portmap.toml at " + to.id + ", at " + from.id +
                   " or in the work tree\nWrite one with: porttool init --source GLOB --target GLOB");
}

std::vector<ScannedFile> scan_side(const Past& past, const GitCommit& commit, const SideGlobs& side, Workplace& place) {
    std::vector<ScannedFile> files;
    for (const GitChange& file :
         past.git->changes("", commit.id, [&](const std::string& path) { return side.takes(path); })) {
        const std::string text = read_blob(past, file.path, file.blob);
        if (const std::string reason = unreadable_reason(text); !reason.empty())
            place.err << "skipped " << terminal_text(file.path) << " at " << commit.id << ": " << reason << "\n";
        else
            files.push_back(scan_text(file.path, text));
    }
    return files;
}

bool names(const Past& past, const std::string& revision, const GitCommit& commit) {
    if (revision.empty()) return false;
    const auto found = past.git->commit(revision);
    return found && found->id == commit.id;
}

/// What the ledger says: of this very change, of changes like it, and of all.
void add_ledger(const Past& past, const std::vector<MapEffort>& ledger, EffortReport& report) {
    std::vector<metrics::RecordedCost> all, own;
    std::map<std::string, std::vector<metrics::RecordedCost>> blocks;
    std::vector<metrics::RecordedPort> ports;
    double anew_hours = 0, anew_lines = 0;
    for (const MapEffort& entry : ledger) {
        if (entry.port && entry.redevelopment) {
            all.push_back({*entry.port, *entry.redevelopment, entry.uncertainty});
            if (!entry.block.empty()) blocks[entry.block].push_back(all.back());
            if (names(past, entry.from, report.from) && names(past, entry.to, report.to)) own.push_back(all.back());
        }
        if (entry.port && entry.lines && entry.novel)
            ports.push_back({*entry.novel, *entry.lines - *entry.novel, entry.port->total()});
        if (entry.redevelopment && entry.lines) {
            anew_hours += entry.redevelopment->total();
            anew_lines += *entry.lines;
        }
    }
    if (const auto degree = metrics::degree_from_hours(own))
        report.degrees.push_back(*degree);
    else
        report.missing.emplace_back(
            "hours: no [[effort]] in portmap.toml has these two commits with hours of port and "
            "redevelopment; porttool effort --format toml writes its lines");
    report.ledger_degree = metrics::degree_from_hours(all);
    for (const auto& [block, records] : blocks)
        if (const auto degree = metrics::degree_from_hours(records)) report.ledger_blocks.emplace_back(block, *degree);
    const metrics::PortFit fit = metrics::fit_ports(ports);
    if (!fit.fit) {
        report.missing.push_back("Hakuta and Ohminami: " + fit.refusal);
        return;
    }
    const PortedEdit& totals = report.effort.totals;
    report.hours = metrics::predicted_hours(fit, static_cast<double>(totals.novel()), totals.carried.shared);
    const double rate = anew_lines > 0 ? anew_hours / anew_lines : 0;
    if (const auto degree = metrics::degree_from_prediction(*report.hours, rate * totals.carried.lines))
        report.degrees.push_back(*degree);
}

}  // namespace

void declare_effort(Declare& declare, Options& options) {
    declare.text("--from", options.from, "REV", "The commit before the change").required();
    declare.text("--to", options.to, "REV", "The commit that ends it (HEAD)");
}

Outcome run_effort(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json", "csv", "toml"});
    const Past past = open_past(options, place);
    EffortReport report;
    report.from = find_commit(past, "--from", options.from);
    report.to = find_commit(past, "--to", options.to);
    report.commits = past.git->commits_between(report.from.id, report.to.id);
    if (!past.git->is_ancestor(report.from.id, report.to.id))
        place.err << "porttool: " << terminal_text(options.from) << " is no ancestor of " << terminal_text(options.to)
                  << (past.git->is_shallow() ? " as far as this shallow clone tells" : "")
                  << "; the two are compared as they are, with what only the former has as removed\n";
    const MapFile map = map_for(past, report.from, report.to);
    require_sides(map, past.map_name);
    const SideGlobs source(map.source), target(map.target);
    const std::vector<ScannedFile> source_before = scan_side(past, report.from, source, place),
                                   source_now = scan_side(past, report.to, source, place),
                                   target_before = scan_side(past, report.from, target, place),
                                   target_now = scan_side(past, report.to, target, place);
    report.weights = map.weights;
    report.effort =
        port_effort(map.pairs, {source_before, source_now, target_before, target_now}, Dialect(map.dialect));
    const metrics::SharedLines& carried = report.effort.totals.carried;
    if (const auto degree = metrics::degree_from_lines(carried, map.weights)) report.degrees.push_back(*degree);
    if (const auto degree = metrics::degree_from_reuse(carried, map.reuse)) report.degrees.push_back(*degree);
    if (report.degrees.empty()) report.missing.emplace_back("lines: the port gained none, so nothing was ported");
    add_ledger(past, past.has_map_today ? past.map_today.efforts : map.efforts, report);
    if (options.format == "json") return {effort_json(report), 0};
    if (options.format == "csv") return {effort_csv(report), 0};
    if (options.format == "toml") return {effort_toml(report), 0};
    return {effort_table(report), 0};
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/range_effort.h"

#include "metrics/portability/reuse.h"
#include "porttool/effort/ledger.h"
#include "porttool/effort/new_pairs.h"
#include "porttool/read/source_files.h"
#include "porttool/scan/scan.h"
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

MapFile map_for(const Past& past, const GitCommit& from, const GitCommit& to) {
    if (past.map_is_given) return past.map_today;
    if (auto map = map_at(past, to)) return *map;
    if (auto map = map_at(past, from)) return *map;
    if (past.has_map_today) return past.map_today;
    throw CannotDo("there is no portmap.toml at " + to.id + ", at " + from.id +
                   " or in the work tree\nWrite one with: porttool init --source GLOB --target GLOB");
}

std::vector<ScannedFile> scan_side(const Past& past, const GitCommit& commit, const SideGlobs& side,
                                   std::ostream& notes) {
    std::vector<ScannedFile> files;
    for (const GitChange& file :
         past.git->changes("", commit.id, [&](const std::string& path) { return side.takes(path); })) {
        const std::string text = read_blob(past, file.path, file.blob);
        if (const std::string reason = unreadable_reason(text); !reason.empty())
            notes << "skipped " << terminal_text(file.path) << " at " << commit.id << ": " << reason << "\n";
        else
            files.push_back(scan_text(file.path, text));
    }
    return files;
}

}  // namespace

RangeEffort range_effort(const Past& past, const GitCommit& from, const GitCommit& to, std::ostream& notes) {
    RangeEffort out;
    out.from = from;
    out.to = to;
    out.commits = past.git->commits_between(from.id, to.id);
    const MapFile map = map_for(past, from, to);
    require_sides(map, past.map_name);
    const SideGlobs source(map.source), target(map.target);
    const std::vector<ScannedFile> source_before = scan_side(past, from, source, notes),
                                   source_now = scan_side(past, to, source, notes),
                                   target_before = scan_side(past, from, target, notes),
                                   target_now = scan_side(past, to, target, notes);
    out.weights = map.weights;
    const ChangedSides sides = {source_before, source_now, target_before, target_now};
    out.effort = port_effort(map.pairs, pairs_of_new_code(map, sides), sides, Dialect(map.dialect));
    const metrics::SharedLines& carried = out.effort.totals.carried;
    if (const auto degree = metrics::degree_from_lines(carried, map.weights)) out.degrees.push_back(*degree);
    if (const auto degree = metrics::degree_from_reuse(carried, map.reuse)) out.degrees.push_back(*degree);
    if (out.degrees.empty()) out.missing.emplace_back("lines: the port gained none, so nothing was ported");
    add_ledger(past, past.has_map_today ? past.map_today : map, out);
    return out;
}

}  // namespace porttool

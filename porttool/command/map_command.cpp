// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/commands.h"
#include "porttool/match/match.h"
#include "porttool/report/map_report.h"
#include "porttool/snapshot/snapshot.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// What the map has settled.
Settled settled_by(const MapFile& map) {
    Settled settled;
    for (const MapPair& pair : map.pairs)
        for (const std::string& target : pair.targets) settled.pairs.emplace_back(pair.source, target);
    for (const MapIgnore& ignore : map.ignores) settled.ignored.push_back(ignore.id);
    return settled;
}

}  // namespace

void declare_map(Declare& declare, Options& options) { declare_sides(declare, options); }

Outcome run_map(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json"});
    const Project project = read_snapshot(open_project(options, place, true), {}, place.disk, Depth::Scanned).project;
    for (const SkippedFile& file : project.skipped)
        place.err << "skipped " << terminal_text(file.file) << ": " << terminal_text(file.reason) << "\n";
    const Matching matching =
        match_units(project.source, project.target, settled_by(project.map), Dialect(project.map.dialect));
    return {options.format == "json" ? map_json(matching) : map_table(matching), 0};
}

}  // namespace porttool

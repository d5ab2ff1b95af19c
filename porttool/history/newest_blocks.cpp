// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/newest_blocks.h"

#include "porttool/judge/check_project.h"

namespace porttool {

std::vector<BlockReport> newest_blocks(const Past& past, const History& history, const Disk& on_disk) {
    Project project;
    project.root = past.root;
    project.map_path = join_path(past.root, "portmap.toml");
    project.map = history.map;
    CheckedProject newest;
    try {
        newest = past_project(project, history.points.back().commit.id, on_disk);
    } catch (const CannotDo&) {
        return {};
    }
    if (!newest.recorded) newest.judgement.findings.clear();  // nothing is judged, as in a report
    const PortabilityCase facts{newest.project.map, newest.project.source, newest.project.target, newest.judgement};
    PortabilityReport report = portability_report(facts, blocks_of(facts));
    report.blocks.push_back(std::move(report.totals));
    return std::move(report.blocks);
}

}  // namespace porttool

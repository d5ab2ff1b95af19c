// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/newest_blocks.h"

#include "porttool/judge/past_project.h"

namespace porttool {

std::vector<BlockReport> newest_blocks(const Past& past, const History& history, const std::string& today) {
    Project project;
    project.root = past.root;
    project.map_path = join_path(past.root, "portmap.toml");
    project.map = history.map;
    PastProject newest;
    try {
        read_past(newest, project, history.points.back().commit.id, today);
    } catch (const CannotDo&) {
        return {};
    }
    if (!newest.is_recorded) newest.judgement.findings.clear();  // nothing is judged, as in a report
    const PortabilityCase facts{newest.project.map, newest.lock.lock, newest.project.source, newest.project.target,
                                newest.judgement};
    PortabilityReport report = portability_report(facts, blocks_of(facts));
    report.blocks.push_back(std::move(report.totals));
    return std::move(report.blocks);
}

}  // namespace porttool

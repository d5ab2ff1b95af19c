// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/two_sides.h"

#include <algorithm>
#include <set>

#include "porttool/text/sink/terminal.h"

namespace porttool {

void require_globs_or_map(const ProjectChoice& choice, const Disk& disk) {
    Project project;
    find_map(project, choice, disk);
    if (project.globs_given || !choice.config.empty() || disk.exists(project.map_path)) return;
    throw CannotDo("no portmap.toml in " + terminal_text(project.root) +
                   " or above; name both sides with --source GLOB --target GLOB, or write one with: porttool init "
                   "--source GLOB --target GLOB");
}

void require_two_sides(const Project& project) {
    if (!project.globs_given || target_root(project) != project.root) return;
    std::set<std::string> sources;
    for (const ScannedFile& file : project.source) sources.insert(file.path);
    const auto shared =
        static_cast<size_t>(std::count_if(project.target.begin(), project.target.end(),
                                          [&](const ScannedFile& file) { return sources.contains(file.path); }));
    if (shared == 0 || shared < std::min(project.source.size(), project.target.size())) return;
    const bool all_sources = shared == project.source.size();
    throw CannotDo(std::string("all files of the ") + (all_sources ? "source" : "target") + " are files of the " +
                   (all_sources ? "target" : "source") +
                   " as well, so that each unit would be paired with itself; give each side globs of its own");
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/command/commands.h"
#include "porttool/match/match.h"
#include "porttool/read/map_file.h"
#include "porttool/read/source_files.h"

namespace porttool {

/// The two sides of a repository, read and scanned.
struct Project {
    std::string root;
    std::string map_path;  ///< where portmap.toml is or would be
    bool has_map = false;
    std::string map_text;
    MapFile map;
    std::vector<ScannedFile> source, target;
    std::vector<SkippedFile> skipped;
};

/// Opens the project that the options name: its root and, if there is one, its map. With both globs given the root is
/// the folder itself and no map is needed. Throws CannotDo.
Project open_project(const Options& options, Workplace& place, bool needs_map);

/// Reads and scans both sides. Throws CannotDo for globs that match nothing.
void read_sides(Project& project, Workplace& place);

/// The same from another disk, without complaint about globs that match nothing there.
void read_sides_from(Project& project, const Disk& disk, const std::string& target_root);

/// The root of the target side, which may be another checkout.
std::string target_root(const Project& project);

/// What the map has settled.
Settled settled_by(const MapFile& map);

}  // namespace porttool

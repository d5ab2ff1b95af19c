// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "porttool/read/cannot_do.h"
#include "porttool/read/map_file.h"
#include "porttool/read/source_files.h"
#include "porttool/read/workplace.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// What a user names of a project.
struct ProjectChoice {
    std::string directory = ".";      ///< where to look for it
    std::string config;               ///< a map other than the nearest; may be empty
    std::vector<std::string> source;  ///< globs; both sides, or neither
    std::vector<std::string> target;
};

/// The two sides of a repository, read and scanned.
struct Project {
    std::string root;
    std::string map_path;                   ///< where portmap.toml is or would be
    std::string map_name = "portmap.toml";  ///< as messages name it
    bool has_map = false;
    bool globs_given = false;  ///< on the command line
    std::string map_text;
    MapFile map;
    std::vector<ScannedFile> source, target;
    std::vector<SkippedFile> skipped;
};

/// The root folder: the nearest one upwards with a portmap.toml, else that of the git work tree, else `directory`.
std::string find_root(const Disk& disk, const std::string& directory);

/// Finds a project's root and where its map is or would be. Throws CannotDo.
void find_map(Project& project, const ProjectChoice& choice, const Disk& disk);

/// What to say where there is no map.
CannotDo no_map(const Project& project);

/// A file in the folder of the map. It is opened beneath the root where that lies there, else beneath the folder.
TreePath beside_map(const Project& project, const std::string& name, Links links = Links::Within);

/// The text of a map. Where it lies beneath the root, whoever proposes a change may have written it, or made it a link.
FileText read_map_text(const Disk& disk, const std::string& root, const std::string& path);

/// Reads the map that was found, if it is there. Throws CannotDo.
void load_map(Project& project, const ProjectChoice& choice, Workplace& place);

/// Opens the project that was chosen: its root and, if there is one, its map. With both globs given the root is
/// the folder itself and no map is needed. Throws CannotDo.
Project open_project(const ProjectChoice& choice, Workplace& place, bool needs_map);

/// Throws CannotDo for a glob of the map that leads out of its side's root, and for a target_root into `.git`.
void require_sides_beneath(const Project& project, const Disk& disk);

/// True where the map has chosen the target's root outside of the project: only sources are read there.
bool is_elsewhere(const Project& project);

/// Takes this text for the project's map. `name`: of the map, for messages. Throws CannotDo.
void use_map(Project& project, const std::string& name, const std::string& text);

/// The root of the target side, which may be another checkout.
std::string target_root(const Project& project);

/// The files of one side that the map's pairs name.
std::set<std::string> named_files(const MapFile& map, Side side);

}  // namespace porttool

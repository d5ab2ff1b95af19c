// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "porttool/command/project.h"
#include "porttool/compare/unit_state.h"
#include "porttool/read/lock_file.h"

namespace porttool {

/// The units of both sides by id, as they stand now.
struct States {
    std::map<std::string, UnitState> source, target;
};

/// Reads the states of all units, and of whole files that the map names (`PATH:@file`).
States read_states(const Project& project);

std::string lock_path(const Project& project);

/// Reads portmap.lock; throws CannotDo if it is not there or cannot be used.
LockFile load_lock(const Project& project, const Disk& disk);

/// Writes portmap.lock and, in portmap.base/, the texts behind its fingerprints; removes texts that it no longer needs.
void store_lock(const Project& project, const LockFile& lock, const States& states, Disk& disk);

/// A text from portmap.base/, or "" if it is not there.
std::string base_text(const Project& project, const Disk& disk, const std::string& print);

}  // namespace porttool

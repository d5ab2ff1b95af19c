// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/snapshot/project.h"

namespace porttool {

/// Throws CannotDo where there are neither globs of both sides nor a map: for commands that do with either.
void require_globs_or_map(const ProjectChoice& choice, const Disk& disk);

/// Throws CannotDo where globs were given and all files of one side are the other's as well: each unit would be paired
/// with itself.
void require_two_sides(const Project& project);

}  // namespace porttool

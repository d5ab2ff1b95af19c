// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/snapshot/project.h"

namespace porttool {

/// A change is held against the merge base of what it is a change of. Throws CannotDo where it put something else in
/// the place of the folder that the user named (a link to another folder, a submodule), or where the map that is found
/// from there, unless the user named one, is another one than the merge base has: its own is gone, or a nearer one is
/// new.
void require_folder_of_base(const Project& project, const ProjectChoice& choice, const std::string& revision,
                            const Disk& disk);

}  // namespace porttool

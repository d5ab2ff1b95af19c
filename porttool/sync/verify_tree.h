// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>

#include "porttool/read/disk.h"

namespace porttool {

/// A work tree of porttool's own, in the user's cache folder, that is kept from one run to the next so that what a
/// command has built there stays. It is ours as long as the guard lives.
struct VerifyTree {
    std::unique_ptr<WriteGuard> guard;
    std::string folder;  ///< what stands for `root` in it
};

/// Makes the tracked files of the repository that `root` lies in, as they stand in its work tree (submodules that are
/// checked out included), those of its verify tree, and then puts `files` there (by their path beneath `root`). Only
/// files that differ are written, those that are tracked no more are removed, and others stay. HEAD and index are the
/// repository's, whose objects are borrowed. The user's repository is only read. Throws CannotDo.
VerifyTree prepare_verify_tree(const std::string& root, const std::map<std::string, std::string>& files, Disk& disk);

}  // namespace porttool

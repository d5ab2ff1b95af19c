// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/read/git_repository.h"

namespace porttool {

/// Makes a folder a git repository that borrows the objects of another (by `objects/info/alternates`), with its HEAD,
/// detached, and the index of that commit; one that is there is brought to that state. Files beside `.git` are left
/// alone, and the other repository is only read. Returns why it could not, or "".
std::string borrow_repository(const GitRepository& other, const std::string& folder);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>

#include "porttool/judge/check_project.h"

namespace porttool {

/// Files of the sides as a commit has them: the lock remembers units, and nothing of what stands around them.
class EarlierFiles {
public:
    /// `checked` must outlive it. `revision`: "HEAD", or one whose merge base with HEAD is meant.
    EarlierFiles(const CheckedProject& checked, std::string revision)
        : checked_(checked), revision_(std::move(revision)) {}

    /// Those of `paths` that the commit has, by path; none outside of any repository.
    std::map<std::string, std::string> read(Side side, const std::set<std::string>& paths) const;

private:
    const CheckedProject& checked_;
    std::string revision_;
};

}  // namespace porttool

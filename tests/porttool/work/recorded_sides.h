// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "porttool/judge/judge.h"
#include "porttool/normal/units_by_id.h"

namespace porttool::testing {

/// Both sides of a repository of two files, recorded with one text and judged with others, without a disk or git.
class RecordedSides {
public:
    explicit RecordedSides(const std::string& text);

    /// As `check` goes through it; returns how many findings there are.
    size_t check(const std::string& source, const std::string& target) const;
    /// As `check --base` does, where the merge base has what is recorded.
    size_t check_against_base(const std::string& source, const std::string& target) const;

private:
    size_t judge_sides(const std::string& source, const std::string& target, bool against_base) const;

    BySide<std::vector<ScannedFile>> files_;
    BySide<UnitsById> states_;
    MapFile map_;
    LockFile lock_;
    std::vector<SkippedFile> skipped_;
    std::map<Print, NormalText> texts_;
};

}  // namespace porttool::testing

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
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

/// The same of the files that a run asks for, read at once when the first of them is.
class EarlierTexts {
public:
    /// Must outlive it.
    explicit EarlierTexts(const EarlierFiles& files) : files_(files) {}

    /// A file that will be asked for.
    void expect(Side side, const std::string& path) { expected_[side].insert(path); }
    /// nullptr for one that the commit has not, and for one that was not expected.
    const std::string* of(Side side, const std::string& path);

private:
    const EarlierFiles& files_;
    BySide<std::set<std::string>> expected_;
    BySide<std::optional<std::map<std::string, std::string>>> texts_;
};

}  // namespace porttool

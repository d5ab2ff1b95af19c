// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/measure/code_lines.h"

namespace porttool {

/// The units of one side at one time, by id. The files must outlive it.
class UnitIndex {
public:
    explicit UnitIndex(const std::vector<ScannedFile>& files);

    /// The unit of an id, or for `PATH:@file` the file as a whole; without a file if there is none.
    Excerpt find(const std::string& id) const;

    /// What a unit was before: the one of that id, or the only one of its name whose id is gone now.
    Excerpt find_before(const std::string& id, const UnitIndex& now) const;

private:
    /// Sorted by hash: a project's ids as texts would take ten times as much.
    struct Entry {
        size_t hash;
        Excerpt excerpt;
    };
    static void sort(std::vector<Entry>& entries);

    std::vector<Entry> by_id_, by_name_;
};

}  // namespace porttool

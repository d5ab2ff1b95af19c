// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/sync/edit_reading.h"
#include "porttool/sync/inserted_uses.h"

namespace porttool {

/// Names from elsewhere, which neither side declares, that the source has a new one for throughout: what both have them
/// from was renamed, so that the port has the new one wherever it had the old, whatever stands around it.
class Renamings : EditReading {
public:
    Renamings(const EditReading& reading, const InsertedUses& uses) : EditReading(reading), uses_(uses) {}

    /// Takes in that a word of the source's new text stands in the place of one of the old.
    void note(size_t was, size_t is);
    bool has(size_t was, size_t is) const;
    /// Adds what renames the rest of the target: all that nothing else replaces.
    void add_to(std::vector<WordsReplaced>& replaced) const;

private:
    bool is_throughout(const std::string& was, const std::string& is) const;

    const InsertedUses& uses_;
    std::map<std::string, std::string> renamed_;
    std::set<std::string> several_;  ///< names that became several
};

}  // namespace porttool

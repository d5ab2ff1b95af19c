// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "porttool/audit/past_edit.h"

namespace porttool {

/// What a statement was before a commit.
struct LineageStep {
    uint32_t commit = 0;      ///< by its place in the walk
    WrittenStatement before;  ///< "" where the commit brought it in
    bool counts = true;       ///< false for an edit that changes no value
};

/// A statement of today and what it was before, newest step first.
struct StatementLineage {
    size_t index = 0;  ///< among the statements of today
    std::vector<LineageStep> steps;
};

/// A statement that a commit took away, and that the unit does not have today.
struct RemovedStatement {
    uint32_t commit = 0;
    WrittenStatement text;
};

/// The statements of a unit as they are today, followed back through the edits of its past.
///
///     today       r = x * 2 ;          s ++ ;
///     commit 9    r = x ;                            a step
///     commit 4                         -             brought in: the end of it
class UnitLineage {
public:
    /// `paired`: the unit is part of a pair; others are followed for the sake of their statements alone.
    explicit UnitLineage(std::vector<WrittenStatement> today, bool paired = true);

    /// Takes in an edit. They come newest first.
    void add(const UnitEdit& edit, uint32_t commit);

    /// The commit brought the unit in: what is older was done to other code.
    void begin(uint32_t commit) { begun_ = commit; }
    /// True if the unit is newer than the commit.
    bool begun_after(uint32_t commit) const { return begun_ && *begun_ < commit; }

    bool paired() const { return paired_; }
    const std::vector<WrittenStatement>& today() const { return today_; }
    const std::vector<StatementLineage>& statements() const { return lines_; }
    const std::vector<RemovedStatement>& removed() const { return removed_; }
    /// True if the commit edited the unit.
    bool edited_in(uint32_t commit) const { return commits_.contains(commit); }
    /// True if a newer commit did.
    bool edited_since(uint32_t commit) const { return !commits_.empty() && commits_.begin()->first < commit; }
    /// The commits that edited it, each with the number of places.
    const std::map<uint32_t, size_t>& edits() const { return commits_; }
    /// In how many places the commit did.
    size_t places_edited(uint32_t commit) const {
        const auto found = commits_.find(commit);
        return found == commits_.end() ? 0 : found->second;
    }

private:
    bool paired_;
    std::vector<WrittenStatement> today_;
    std::vector<StatementLineage> lines_;
    std::unordered_multimap<std::string, size_t> live_;  ///< by what each was, as far back as the walk has come
    std::vector<RemovedStatement> removed_;
    std::map<uint32_t, size_t> commits_;  ///< with the number of places
    std::optional<uint32_t> begun_;       ///< none where the walk does not reach so far
};

}  // namespace porttool

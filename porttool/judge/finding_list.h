// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "porttool/judge/judgement.h"
#include "porttool/read/map_file.h"
#include "porttool/read/target_sets.h"

namespace porttool {

/// An id as the argument of a command that a person pastes into a shell. What cannot be pasted, as a name with a line
/// break, goes by the finding's fingerprint.
std::string argument(const std::string& id, const Finding& finding);

/// The findings of one judgement while it is made. Each begins with what its rule says: level, remedy, fingerprint.
class FindingList {
public:
    /// `map` must outlive it.
    explicit FindingList(const MapFile& map);

    /// Adds a finding outside pairs. Like all that are handed out, it stays valid until the next one is added.
    Finding& add(Rule rule, const std::string& id);

    /// Adds a finding on a unit without a counterpart, in one port where there are several.
    Finding& add(Rule rule, const UnitState& unit, Side side, const std::string& set = {});

    /// Adds a finding on a pair. `subject` tells it from others of the same rule on it, where there may be several.
    Finding& add(Rule rule, const JudgedPair& pair, std::optional<ChangeKind> change, const std::string& message,
                 const std::string& subject = {});

    /// What findings of a rule weigh in this project.
    Level level_of(Rule rule) const;

    size_t size() const { return findings_.size(); }
    std::span<Finding> from(size_t first) { return std::span(findings_).subspan(first); }
    void drop_last() { findings_.pop_back(); }
    void drop(size_t at) { findings_.erase(findings_.begin() + static_cast<std::ptrdiff_t>(at)); }

    /// All of them, sorted by place. Their fingerprints differ: those that are alike in all but their place, as two
    /// idle comments in one file, are told apart by their order. Ends the list.
    std::vector<Finding> finish();

    /// Ids keep the paths of their side; a place's file leads there from the root, also into another checkout.
    Place place_of(const UnitState& unit, Side side) const;

private:
    Finding& begin(Rule rule, const std::string& source, const std::string& target, const std::string& subject);

    const MapFile& map_;
    TargetSets sets_;
    std::unordered_map<std::string_view, size_t> ports_of_;  ///< how many targets a source of the map has
    std::vector<Finding> findings_;
};

}  // namespace porttool

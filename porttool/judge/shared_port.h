// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "porttool/judge/mapped_pair.h"
#include "porttool/judge/other_parts.h"
#include "porttool/judge/pair_judge.h"

namespace porttool {

/// Units that are the port of several originals. An edit of one answers the edit of one original; to the others it is
/// no news, also where the two edits are not alike, which is told of that pair. Where no original was edited, one
/// finding says so, not one for each pair.
class SharedPorts {
public:
    /// All must outlive it.
    SharedPorts(const Case& facts, const BySide<RenamedNames>& renamed, const std::vector<MappedPair>& pairs);

    /// What the finding that the port alone of a pair changed is worth.
    enum class Worth : uint8_t { Tell, Told, Explained };
    /// Asked once for each such finding, in the order of the pairs.
    Worth worth_of(const MappedPair& pair);

    /// What the edit of the pair's port is to its original, which was edited too: nothing to it where all of it lies in
    /// the parts of others.
    EditOfParts edit_of(const MappedPair& pair);

    /// The side of the ports.
    Side side() const { return side_; }

private:
    struct Group {
        std::vector<const MappedPair*> pairs;
        std::map<Print, Worth> answers;  ///< to an edit, by the print of the recorded text: what pairs make of it
        bool told = false;
    };

    Worth answer_of(const MappedPair& pair);
    bool is_original_edited(const MappedPair& pair) const;

    const Case& facts_;
    const BySide<RenamedNames>& renamed_;
    Side side_;
    OtherParts parts_;
    std::map<const UnitState*, Group> groups_;  ///< of units in more than one pair
};

}  // namespace porttool

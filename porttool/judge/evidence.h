// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What programs that ran both sides saw, joined to what the texts say.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "porttool/judge/judgement.h"
#include "porttool/judge/use_graph.h"
#include "porttool/read/evidence_file.h"
#include "porttool/snapshot/states.h"

namespace porttool {

/// Those of these files, by path from the root, whose text has another print in this project.
std::vector<std::string> other_texts(const std::vector<std::pair<std::string, std::string>>& texts,
                                     const Project& project);

/// Reads these files. Throws CannotDo, also where a text that ran is another one in this project; all such are named.
std::vector<EvidenceFile> evidence_of(const std::vector<std::string>& paths, const Project& project, const Disk& disk);

/// Joins evidence to a judgement. Both, and the states, must outlive it.
///
/// What explains a difference is a finding that an edit of one side, or two edits that differ, made: one on the unit
/// that differs, or on what it uses in whatever many steps, on either side. For a kernel of a picture that begins at
/// its entry functions. Findings that a person settled explain as well, unless their own pair ran and gave the same;
/// notes do not.
class EvidenceJoin {
public:
    EvidenceJoin(const std::vector<EvidenceFile>& files, const States& states);

    /// Which differences no finding explains, and which pairs were seen to be the same.
    RunEvidence unexplained(const Judgement& judgement) const;

    /// Adds to each finding that explains a difference, or is of one, what was seen of it.
    void join(Judgement& judgement) const;

    /// How many pairs of the evidence are none of the map.
    size_t strangers(const Judgement& judgement) const;

private:
    using Marked = std::map<const UnitState*, size_t>;
    /// Units that a pair which differs uses, by its number among the pairs of the map, and those that a kernel uses.
    struct Marks {
        BySide<Marked> pairs, kernels;
    };
    bool is_settled_for_nothing(const Finding& finding) const;
    std::vector<const UnitState*> units_of(const std::string& id, Side side) const;
    std::vector<const UnitState*> entry_units(const SeenKernel& kernel, Side side) const;
    Marks marks_of(const Judgement& judgement) const;
    size_t least_mark(const BySide<Marked>& marks, const Finding& finding) const;
    const SeenPair* pair_of(const Finding& finding, const Marks& marks, const Judgement& judgement) const;
    size_t kernel_of(const Finding& finding, const Marks& marks) const;

    const States& states_;
    BySide<UseGraph> graph_;
    std::map<std::pair<std::string, std::string>, const SeenPair*> pairs_;  ///< the one that differs, where some do
    std::vector<std::pair<const SeenKernel*, std::string>> kernels_;        ///< with the folder of their file
};

}  // namespace porttool

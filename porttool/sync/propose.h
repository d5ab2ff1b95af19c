// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "porttool/judge/check_project.h"
#include "porttool/sync/drafts.h"
#include "porttool/sync/proposal.h"

namespace porttool {

/// All that a proposal changes beneath the root of the side that is written, and what it changes elsewhere.
std::string whole_patch(const Proposal& proposal);
std::string map_patch(const Proposal& proposal);

/// The proposals of one run, in the order in which their patches apply.
struct SyncResult {
    std::vector<Proposal> proposals;
    ProposedFiles files;  ///< of whole proposals
    ProposedFiles files_with_partial;
    Valueless valueless;  ///< what a part of a port would take a value of, and which part
    /// True if something is left for a person.
    bool any_left() const;
};

/// Which side is written: the one that did not change, or, where both did, the one that is not the contract.
enum class WriteSide : uint8_t { Other, Source, Target };

/// Proposes ports of the pairs, by their places in the judgement. Throws CannotDo.
/// `commit`: what stands in for "before" where the lock tells nothing, as of includes.
SyncResult propose(const CheckedProject& checked, const std::vector<size_t>& pairs, WriteSide write, const Disk& disk,
                   const std::string& commit = "HEAD");

}  // namespace porttool

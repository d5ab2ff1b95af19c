// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/sync/drafts.h"
#include "porttool/sync/knowledge.h"
#include "porttool/sync/new_units.h"
#include "porttool/sync/proposal.h"
#include "porttool/sync/record_draft.h"

namespace porttool {

/// Takes a port away whose counterpart is gone, once nothing of its side uses it any more.
class UnitRemover {
public:
    /// All must outlive it.
    UnitRemover(const CheckedProject& checked, Knowledge& knowledge, Drafts& drafts, RecordDraft& record)
        : checked_(checked), knowledge_(knowledge), drafts_(drafts), record_(record) {}

    /// Cuts the unit of side `to` out of its file, with its comment where the other side's went as well, and its pair
    /// out of the project's own files. `so_far`: what the run proposes before. Why that is not certain; "" if it was
    /// done.
    std::string remove(const JudgedPair& pair, Side to, const std::vector<Proposal>& so_far, const NewUnits& new_units);

private:
    std::string user_of(const std::string& name, const JudgedPair& pair, Side to, const std::vector<Proposal>& so_far);
    void cut_out(const JudgedPair& pair, Side to, Draft& draft);

    const CheckedProject& checked_;
    Knowledge& knowledge_;
    Drafts& drafts_;
    RecordDraft& record_;
};

}  // namespace porttool

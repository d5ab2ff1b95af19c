// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/sync/drafts.h"
#include "porttool/sync/pair_record.h"

namespace porttool {

/// What a run does to the project's own files: as the drafts have them after each proposal.
class RecordDraft {
public:
    /// All must outlive it.
    RecordDraft(const CheckedProject& checked, const Disk& disk, Drafts& drafts)
        : checked_(checked), record_(checked, disk), drafts_(drafts) {}

    /// All pairs that came with the run. Throws CannotDo, as the other two.
    void set_made(std::vector<FreshPair> made);
    /// A pair that is brought in step is no longer deferred; nothing where it was not.
    void end_deferral(const BySide<std::string>& pair);
    /// A pair whose both units are gone.
    void remove(const BySide<std::string>& pair);

private:
    void write(RecordEdits edits);

    const CheckedProject& checked_;
    PairRecord record_;
    Drafts& drafts_;
    RecordEdits edits_;
};

}  // namespace porttool

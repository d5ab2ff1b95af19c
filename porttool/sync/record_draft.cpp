// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/record_draft.h"

#include <algorithm>

namespace porttool {

void RecordDraft::set_made(std::vector<FreshPair> made) {
    RecordEdits edits = edits_;
    edits.made = std::move(made);
    write(std::move(edits));
}

void RecordDraft::end_deferral(const BySide<std::string>& pair) {
    const auto defers = [&](const LedgerEntry& one) {
        return one.verdict == Verdict::Defer && one.source == pair.source && one.target == pair.target;
    };
    if (checked_.against_base || std::none_of(checked_.lock.ledger.begin(), checked_.lock.ledger.end(), defers)) return;
    RecordEdits edits = edits_;
    edits.in_step.push_back(pair);
    write(std::move(edits));
}

void RecordDraft::remove(const BySide<std::string>& pair) {
    RecordEdits edits = edits_;
    edits.removed.push_back(pair);
    write(std::move(edits));
}

void RecordDraft::write(RecordEdits edits) {
    drafts_.write_record(record_.with(edits));
    edits_ = std::move(edits);
}

}  // namespace porttool

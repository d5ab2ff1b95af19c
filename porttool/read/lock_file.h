// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/text/fingerprint.h"

namespace porttool {

/// A pair as it was when its sides were last in step.
struct LockedPair {
    std::string source, target;
    Fingerprints source_prints, target_prints;
};

/// A source unit that had no counterpart when the baseline was taken.
struct LockedUnit {
    std::string id;
    std::string print;
    std::string reason = {};  ///< why it needs none, if somebody said so
};

/// A verdict that a person gave on a pair, for the texts that it had then.
struct LedgerEntry {
    std::string verdict;  ///< "accept", "defer" or "ignore"
    std::string source, target;
    std::string source_print, target_print;
    std::string owner;
    std::string until;  ///< YYYY-MM-DD: the last day of a deferral; the day of an acceptance
    std::string reason;
};

struct LockFile {
    std::vector<LockedPair> pairs;
    std::vector<LockedUnit> baseline;
    std::vector<LedgerEntry> ledger;
};

/// A lock, or why it cannot be used and what to do.
struct ReadLock {
    LockFile lock;
    std::string error;
};

ReadLock read_lock(const std::string& text);

/// The text of a lock: one sorted line a fact, fields apart by tabs, so that merges are unions.
std::string lock_text(const LockFile& lock);

}  // namespace porttool

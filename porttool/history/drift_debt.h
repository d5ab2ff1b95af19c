// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "porttool/history/blob_facts.h"

namespace porttool {

using PairId = std::pair<std::string, std::string>;  ///< source, target: ids in the map

/// A pair as one commit has it.
struct PairNow {
    const UnitFacts* source = nullptr;  ///< nullptr where it is not there
    const UnitFacts* target = nullptr;
    const Fingerprints* locked_source = nullptr;  ///< what the commit's lock says of when they were in step
    const Fingerprints* locked_target = nullptr;
    bool ignored = false;  ///< the lock's ledger settles it for these texts
};

/// A pair that one side has left: since when, and how much waits.
struct OpenPair {
    PairId id;
    int64_t since = 0;  ///< seconds since 1970
    uint32_t lines = 0;

    double debt(int64_t now) const;  ///< line-days
};

/// Follows all pairs through history, commit by commit, to tell which are open. A pair is open from the commit in which
/// one of its sides differs from when both were last in step by more than the names of locals and parameters, until the
/// commit in which both sides' edits are equivalent, the texts are again what they were, or the lock says so. Where
/// there is no lock, edits of both sides that resemble each other by half or more close it, too, and the first sight of
/// a pair counts as in step. Where the port was removed and its source is still there, the pair is open with all of the
/// source's lines.
class DriftReplay {
public:
    /// Compares the edits from the first and third texts to the second and fourth, given by their prints.
    using CompareEdits = std::function<EditFacts(const Fingerprints& source_before, const UnitFacts& source_now,
                                                 const Fingerprints& target_before, const UnitFacts& target_now)>;
    explicit DriftReplay(CompareEdits compare) : compare_(std::move(compare)) {}

    /// Takes in what a commit did to a pair. `time`: of the commit.
    void update(const PairId& id, const PairNow& now, int64_t time);
    /// Drops a pair that the map no longer has.
    void forget(const PairId& id);

    std::vector<OpenPair> open() const;  ///< sorted by id
    double debt(int64_t now) const;      ///< line-days: the sum over the open pairs of age in days x lines
    size_t open_count() const { return open_.size(); }

private:
    struct Base {
        Fingerprints source, target;
    };
    CompareEdits compare_;
    std::map<PairId, Base> bases_;
    std::map<PairId, OpenPair> open_;
};

}  // namespace porttool

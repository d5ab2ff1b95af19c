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
/// it is out of step, as compare_pair() judges it for `check` as well, until one in which it is in step again or the
/// lock says so. On purpose this differs from the findings of `check`:
/// - where a commit has no lock, edits of both sides that resemble each other by half or more close a pair, too, since
///   nobody accepts ports there that are free;
/// - the first sight of a pair that no lock knows counts as in step, where `check` asks for a first acceptance;
/// - of the ledger only 'ignore' settles debt: what is deferred is still owed. Neither comments in the code nor [rules]
///   nor compilers (`check --spirv`) are asked;
/// - edits that `check` weakens to a note are debt until they are recorded;
/// - a text that portmap.base/ has lost may still be known from an earlier commit;
/// - the budget of comparing is a commit's, and counts only the pairs that the commit touched;
/// - where the port was removed and its source is still there, the pair is open with all of the source's lines.
class DriftReplay {
public:
    /// Judges a pair by the prints of its texts when last in step, and now.
    using CompareEdits = std::function<EditFacts(const PairId& id, const BySide<Fingerprints>& before,
                                                 const BySide<const UnitFacts*>& now)>;
    explicit DriftReplay(CompareEdits compare) : compare_(std::move(compare)) {}

    /// Takes in what a commit did to a pair. `time`: of the commit.
    void update(const PairId& id, const PairNow& now, int64_t time);
    /// Drops a pair that the map no longer has.
    void forget(const PairId& id);

    std::vector<OpenPair> open() const;  ///< sorted by id
    double debt(int64_t now) const;      ///< line-days: the sum over the open pairs of age in days x lines
    size_t open_count() const { return open_.size(); }

private:
    CompareEdits compare_;
    std::map<PairId, BySide<Fingerprints>> bases_;
    std::map<PairId, OpenPair> open_;
};

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What accept, defer and ignore do to the lock.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "porttool/judge/judgement.h"
#include "porttool/read/lock_file.h"
#include "porttool/read/target_sets.h"

namespace porttool {

/// True for a finding on that pair.
bool is_of(const Finding& finding, const JudgedPair& pair);

/// What an id stands for among what was judged.
struct Named {
    std::vector<const JudgedPair*> pairs;  ///< in the order of the map
    std::vector<const Finding*> lone;      ///< findings outside pairs
};

/// An id is that of either side, SOURCE=TARGET, or a finding's fingerprint.
Named named_by(const Judgement& judgement, const std::string& id);

/// The unit of that id, if no pair leads to it and its side is the contract; else nullptr.
const LoneUnit* find_lone(const Judgement& judgement, const std::string& id);

/// The id, fingerprint or rule that is most like an id which names nothing; "" if none is near.
std::string nearest_named(const Judgement& judgement, const std::string& id);

/// The pairs that changed since they were in step.
struct ChangedPairs {
    std::vector<const JudgedPair*> alike;      ///< both edits are equivalent
    std::vector<const JudgedPair*> different;  ///< they are not, or the pair is new to the lock
    /// Both edits are equivalent, but macros changed what the words say, and another pair tells of that: recording one
    /// would settle it for all.
    std::vector<const JudgedPair*> under_macros;
};
ChangedPairs changed_pairs(const Judgement& judgement);

/// What a person did before accepting pairs: named each, or took them all.
enum class Looked : uint8_t { AtEach, AtNone };

/// Records pairs as in step with today's texts, and forgets what was said of them before. A reason is kept beside each,
/// with its day. Pairs that somebody looked at are verified by that; of others, those stay so whose edits are
/// equivalent.
void accept_pairs(LockFile& lock, const std::vector<const JudgedPair*>& pairs, const TargetSets& sets, Looked looked,
                  const std::string& reason, const std::string& today);

/// Marks the lines of these pairs, source and target, as verified by what `by` says, where the lock has them in step
/// with today's texts and nobody has verified them yet. Returns how many.
size_t verify_pairs(LockFile& lock, const Judgement& judgement,
                    const std::set<std::pair<std::string, std::string>>& pairs, const std::string& by);

/// Gives the lines of the baseline the ids that their units have today. Goes first, before the lock is changed.
void follow_baseline(LockFile& lock, const Judgement& judgement);

/// True for a finding on a unit without a counterpart that nobody has looked at.
bool is_of_new_unit(const Finding& finding);

/// Takes every unit that has such a finding into the baseline, and every edited one of the baseline as it is now.
void accept_unwatched(LockFile& lock, const Judgement& judgement, const BySide<UnitsById>& units,
                      const std::string& reason);

/// Forgets a pair that `map` no longer names. Units that stand in no other go back to the baseline.
void reject_pair(LockFile& lock, const JudgedPair& pair, const MapFile& map);

/// Defers or ignores a pair with its texts of today. `said` has the verdict, owner, day and reason.
void settle_pair(LockFile& lock, const JudgedPair& pair, LedgerEntry said);

/// The same of a unit without a counterpart. To ignore it makes it part of the baseline, with the reason.
void settle_lone(LockFile& lock, const UnitState& unit, Side side, LedgerEntry said);

}  // namespace porttool

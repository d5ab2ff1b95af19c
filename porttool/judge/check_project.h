// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "porttool/judge/judge.h"
#include "porttool/snapshot/snapshot.h"

namespace porttool {

/// What the judgement of a project rests on, as a user asks for it.
struct CheckChoice : ProjectChoice {
    std::string base;          ///< a revision: its merge base with HEAD stands in for the lock
    bool staged = false;       ///< the index in place of the work tree
    bool trusted_map = false;  ///< with `base`: map and lock from there
    /// A project without a lock is read, too: all but when its pairs were in step, so there are no findings.
    bool lock_is_optional = false;
    std::vector<std::string> run_evidence;  ///< files of what programs that ran both sides saw
};

/// A snapshot with everything that its judgement rests on. The judgement points into the states: keep them together.
struct CheckedProject : Snapshot {
    bool recorded = false;      ///< there was a lock
    bool against_base = false;  ///< a merge base stands in for it
    LockFile lock = {};
    std::optional<LockFile> in_project = {};  ///< with a base: the lock that stands in the project, if one does
    std::map<Print, UnitText> texts = {};     ///< by print: those behind the lock that portmap.base/ does not have
    /// With a merge base: pairs, by their ids, of which one side was gone there already.
    std::set<std::pair<std::string, std::string>> gone_before = {};
    States base_states = {};  ///< with a merge base: the units there
    BySide<NewWords> new_words = {};
    std::vector<PlacedSuppression> suppressions = {};
    Judgement judgement = {};
};

/// The text behind a print of the lock; empty if there is none.
NormalText text_behind(const CheckedProject& checked, Print print);

/// What can tell that an edited function compiles to the same code; asked for once the project is read.
using SameCodeIn = std::function<SameCode(const Snapshot& snapshot)>;

/// Reads, scans and judges. Throws CannotDo. `last`: what the same choice gave before; of the work tree only what
/// changed since then is scanned again. It is used up. `kept`: facts of files from earlier runs; where these are used,
/// the files of the project are there by `files()` alone.
CheckedProject check_project(const CheckChoice& choice, Workplace& place, const SameCodeIn& same_code_in = {},
                             CheckedProject* last = nullptr, FactsStore* kept = nullptr);

/// A project as it was at merge-base(REV, HEAD), under today's sides, blocks and dialect, so that figures compare, but
/// with the pairs that its own map named. Throws CannotDo.
CheckedProject past_project(const Project& today, const std::string& revision, const Disk& on_disk);

}  // namespace porttool

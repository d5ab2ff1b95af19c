// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/audit/audit.h"
#include "porttool/audit/todays_pairs.h"
#include "porttool/judge/check_project.h"

namespace porttool {

/// Asks `sync` for the port of edits of the past: as if the edited side had been in step without them.
class PortPatches {
public:
    /// Takes the snapshot; the pairs and the disk must outlive it.
    PortPatches(TodaysPairs& today, const Disk& disk);

    /// Gives an item the proposal for the other side, whole or in part, and what it leaves for a person. False where
    /// `sync` says that no port is due.
    bool add_to(AuditItem& item);

    const Project& project() const { return checked_.project; }
    const States& states() const { return checked_.states; }

private:
    CheckedProject checked_;
    const Disk& disk_;
};

/// A unit's text without what an edit did to it: the statements before stand in the place of those now, as far as that
/// can be told. Empty where it can be told of none.
NormalText text_without(const UnitState& unit, const std::vector<MissingPlace>& places);

}  // namespace porttool

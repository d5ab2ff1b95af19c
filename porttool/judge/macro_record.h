// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What the record has of macros that give words of paired units a meaning.
#pragma once

#include <cstddef>
#include <vector>

#include "porttool/judge/judgement.h"
#include "porttool/read/lock_file.h"
#include "porttool/snapshot/states.h"

namespace porttool {

/// Notes in each line of a pair whose recorded texts are those of `states` what macros make of its words, where the
/// line does not say it yet, or says it without keywords and otherwise as it is. `files` and `states` are of one
/// moment. Returns the number of those lines.
size_t note_macros(LockFile& lock, const BySide<FilesOfSide>& files, const States& states);

/// The same for the lines of pairs that were accepted, and of all others whose words the same edits of macros changed:
/// who looked at one has looked at all.
void note_macros(LockFile& lock, const Judgement& judgement, const std::vector<const JudgedPair*>& accepted,
                 const BySide<FilesOfSide>& files, const States& states);

}  // namespace porttool

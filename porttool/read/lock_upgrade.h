// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>

#include "porttool/normal/units_by_id.h"
#include "porttool/read/lock_file.h"

namespace porttool {

/// True if the prints of a lock are of an older normal form than today's, and cannot be held against today's texts.
bool is_outdated(const LockFile& lock);

/// A lock whose prints are today's, with the texts behind those that were found.
struct UpgradedLock {
    LockFile lock;
    std::map<Print, UnitText> texts;  ///< by today's print
    std::string error;                ///< which text is missing, and what to do
};

/// Gives every print of an outdated lock anew, from the text behind it. `text_of` gives the text that portmap.base/ has
/// for an old print, or "". `today` are the units as they are now: where a text is still the recorded one, its prints
/// are known. A pair's text that is nowhere is an error; an old verdict on a text that is nowhere holds no longer.
UpgradedLock upgraded(LockFile lock, const std::function<std::string(Print print)>& text_of,
                      const std::vector<const UnitsById*>& today);

/// The text of a file of portmap.base/ if it is the one that its name says, as this normal form names it; else empty.
NormalText text_of_print(Print print, const std::string& recorded, int normal_form);

/// True if it is, of today's normal form. Takes a third of the time.
bool is_text_of_print(Print print, const std::string& recorded);

}  // namespace porttool

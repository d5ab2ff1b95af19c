// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "porttool/audit/lineage.h"
#include "porttool/scan/side.h"

namespace porttool {

/// A place in which the other side does not have what an edit did.
struct MissingPlace {
    enum class Kind : uint8_t { Replaced, Added, Removed };
    Kind kind = Kind::Replaced;
    WrittenStatement before, now;  ///< before the edit, and today; one is "" where a statement came or went
    WrittenStatement behind;       ///< of a statement that came: the one before it today; "" for none
    WrittenStatement there;        ///< the statement of the other side that says what was before; "" for none
    float strength = 0;            ///< how sure it is that the other side lacks it and should not, 0 to 1
    float around = 0;              ///< share of the words around it that both sides have, 0 to 1
    bool constants_only = false;   ///< nothing but numbers changed
    bool widens = false;           ///< nothing but the width of an integer did
};

/// What one commit did to one side of a pair and the other side lacks.
struct MissingEdit {
    Side side = Side::Source;  ///< that was edited
    uint32_t commit = 0;       ///< by its place in the walk
    std::vector<MissingPlace> places;
    bool both = false;   ///< the commit edited the other side, too
    bool since = false;  ///< the other side was edited later
    bool past = false;   ///< the other side was written later
    size_t size = 0;     ///< places of the unit that the commit edited, here or not
};

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/scan/unit.h"

namespace porttool {

/// What a function's body does, as far as its tokens tell.
struct BodyTraits {
    bool launches = false;        ///< it calls what sets a kernel's arguments or enqueues it, whatever the API
    bool sets_arguments = false;  ///< it sets a kernel's arguments
    bool holds_kernel = false;    ///< it enqueues a lambda of several statements
    bool computes = false;        ///< it has a loop, arithmetic, or stores what it works out at an index that varies
    bool works = false;           ///< the same, and more arithmetic than a wrapper has
    bool acts = false;            ///< has a loop or a store at an index
    bool stores = false;          ///< it writes to an index that varies
};

/// Reads a unit's body once.
BodyTraits read_body_traits(const ScannedFile& file, const Unit& unit);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/effort/range_effort.h"

namespace porttool {

/// Adds what the ledger (the map's [[effort]] entries) says of this very change, of changes like it, and of all.
void add_ledger(const Past& past, const MapFile& map, RangeEffort& range);

}  // namespace porttool

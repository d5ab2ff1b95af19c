// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/watched_units.h"

namespace porttool {

bool WatchedUnits::contains(Side side, std::string_view id) {
    if (!ids_) {
        auto& ids = ids_.emplace();
        for (const MapPair& pair : map_.pairs) {
            ids.source.insert(pair.source);
            ids.target.insert(pair.targets.begin(), pair.targets.end());
        }
    }
    return (*ids_)[side].contains(id);
}

}  // namespace porttool

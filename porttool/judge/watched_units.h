// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <unordered_set>

#include "porttool/read/map_file.h"

namespace porttool {

/// The units that the pairs of a map name.
class WatchedUnits {
public:
    /// `map` must outlive it.
    explicit WatchedUnits(const MapFile& map) : map_(map) {}

    bool contains(Side side, std::string_view id);

private:
    const MapFile& map_;
    std::optional<BySide<std::unordered_set<std::string_view>>> ids_;  ///< filled when first asked
};

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace porttool {

/// Called after each row that is added to a text: makes room for all of many rows at once, by the size of the first
/// ones. A text that doubles its room as it grows has three times its size in memory while it does.
inline void make_room_for_rows(std::string& text, size_t added, size_t all) {
    constexpr size_t kFirst = 1024, kSpare = 8;
    if (added == kFirst && all > kFirst) text.reserve(text.size() / kFirst * (all + all / kSpare));
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>

namespace porttool {

/// Calls `visit` with each word of a list that blanks separate, as the tables of this room are written.
template <class Visit>
constexpr void for_each_word(std::string_view list, const Visit& visit) {
    while (!list.empty()) {
        const size_t end = std::min(list.find(' '), list.size());
        if (end > 0) visit(list.substr(0, end));
        list.remove_prefix(std::min(end + 1, list.size()));
    }
}

}  // namespace porttool

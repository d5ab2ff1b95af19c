// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace porttool {

/// The value of an enum whose values `names` spells out in their order; none if the text is no name.
template <class Enum, size_t kCount>
constexpr std::optional<Enum> value_named(const std::array<std::string_view, kCount>& names, std::string_view text) {
    for (size_t i = 0; i < kCount; ++i)
        if (names[i] == text) return static_cast<Enum>(i);
    return std::nullopt;
}

}  // namespace porttool

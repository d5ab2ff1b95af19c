// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace porttool {

/// The two sides of a port: the original, and what was made from it.
enum class Side : uint8_t { Source, Target };

constexpr std::array<Side, 2> kBothSides = {Side::Source, Side::Target};

constexpr Side other(Side side) { return side == Side::Source ? Side::Target : Side::Source; }

/// One of each side.
template <class T>
struct BySide {
    T source, target;

    T& operator[](Side side) { return side == Side::Source ? source : target; }
    const T& operator[](Side side) const { return side == Side::Source ? source : target; }

    bool operator==(const BySide&) const = default;
};

}  // namespace porttool

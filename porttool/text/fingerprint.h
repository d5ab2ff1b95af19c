// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/text/fingerprint.h"

namespace porttool {

/// A 64-bit hash of bytes, the same on every machine. For tables: whoever knows it can make two texts of one hash.
uint64_t hash_text(std::string_view text, uint64_t seed = 0);

using metrics::Fingerprinter;
using metrics::SipHash;

/// True for so many hexadecimal digits, small ones.
bool is_hexadecimal(std::string_view text, size_t digits);

/// True for what Fingerprinter::digits() can give: 16 small hexadecimal digits, not all 0.
bool is_fingerprint(std::string_view text);

/// What a text is known by: the bits of a fingerprint, or that there is none, as of a text that is not there.
class Print {
public:
    constexpr Print() = default;
    constexpr explicit Print(uint64_t bits) : bits_(bits) {}
    explicit Print(const Fingerprinter& text) : bits_(text.bits()) {}
    /// From 16 small hexadecimal digits; of any other text there is none.
    static Print read(std::string_view digits);

    constexpr bool is_known() const { return bits_ != 0; }
    constexpr uint64_t bits() const { return bits_; }
    /// The digits, or `-` where there is none.
    std::string text() const;

    constexpr auto operator<=>(const Print&) const = default;

private:
    uint64_t bits_ = 0;
};

/// The print that a lock of version 1 has for the words of a text.
Print fingerprint_of_version_1(const std::vector<std::string_view>& words);

/// What tells whether a unit changed, and how.
struct Fingerprints {
    Print written;  ///< as written, without what is cosmetic
    Print renamed;  ///< with locals and parameters numbered
    Print blanked;  ///< ... and numbers blanked

    bool operator==(const Fingerprints&) const = default;
};

}  // namespace porttool

/// For tables. A print is a hash already.
template <>
struct std::hash<porttool::Print> {
    size_t operator()(porttool::Print print) const noexcept { return static_cast<size_t>(print.bits()); }
};

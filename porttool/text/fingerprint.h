// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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

/// True for what Fingerprinter::digits() can give: 16 small hexadecimal digits.
bool is_fingerprint(std::string_view text);

/// The print that a lock of version 1 has for the words of a text.
std::string fingerprint_of_version_1(const std::vector<std::string_view>& words);

/// What tells whether a unit changed, and how.
struct Fingerprints {
    std::string written;  ///< as written, without what is cosmetic
    std::string renamed;  ///< with locals and parameters numbered
    std::string blanked;  ///< ... and numbers blanked

    bool operator==(const Fingerprints&) const = default;
};

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace porttool {

/// A 64-bit hash of bytes, the same on every machine.
uint64_t hash_text(std::string_view text, uint64_t seed = 0);

/// 64 bits over texts in their order, as 16 hexadecimal digits.
class Fingerprinter {
public:
    void add(std::string_view text);
    std::string digits() const;

private:
    uint64_t hash_ = 0;
};

/// What tells whether a unit changed, and how.
struct Fingerprints {
    std::string written;  ///< as written, without what is cosmetic
    std::string renamed;  ///< with locals and parameters numbered
    std::string blanked;  ///< ... and numbers blanked

    bool operator==(const Fingerprints&) const = default;
};

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/fingerprint.h"

#include <array>
#include <cstdio>

namespace porttool {

uint64_t hash_text(std::string_view text, uint64_t seed) {
    uint64_t hash = 0xCBF29CE484222325ull ^ (seed * 0x9E3779B97F4A7C15ull);  // FNV-1a
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
    hash ^= hash >> 32;
    hash *= 0xD6E8FEB86659FD93ull;
    return hash ^ (hash >> 32);
}

void Fingerprinter::add(std::string_view text) { hash_ = hash_text(text, hash_ + 1); }

std::string Fingerprinter::digits() const {
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash_));
    return text.data();
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/fingerprint.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

namespace porttool {
namespace {

constexpr size_t kDigits = 16;

std::string hexadecimal(uint64_t number) {
    std::array<char, kDigits + 1> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(number));
    return text.data();
}

}  // namespace

uint64_t hash_text(std::string_view text, uint64_t seed) {
    uint64_t hash = 0xCBF29CE484222325ull ^ (seed * 0x9E3779B97F4A7C15ull);  // FNV-1a
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
    hash ^= hash >> 32;
    hash *= 0xD6E8FEB86659FD93ull;
    return hash ^ (hash >> 32);
}

bool is_hexadecimal(std::string_view text, size_t digits) {
    return text.size() == digits && std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
           });
}

bool is_fingerprint(std::string_view text) {
    return is_hexadecimal(text, kDigits) && text.find_first_not_of('0') != std::string_view::npos;
}

Print Print::read(std::string_view digits) {
    uint64_t bits = 0;
    if (is_fingerprint(digits)) std::from_chars(digits.data(), digits.data() + digits.size(), bits, 16);
    return Print(bits);
}

std::string Print::text() const { return is_known() ? hexadecimal(bits_) : "-"; }

Print fingerprint_of_version_1(const std::vector<std::string_view>& words) {
    uint64_t hash = 0;
    for (const std::string_view word : words) hash = hash_text(word, hash + 1);
    return Print(hash);
}

}  // namespace porttool

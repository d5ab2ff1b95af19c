// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/fingerprint.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>

namespace porttool {
namespace {

constexpr size_t kDigits = 16;
constexpr size_t kWord = sizeof(uint64_t);

std::string hexadecimal(uint64_t number) {
    std::array<char, kDigits + 1> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(number));
    return text.data();
}

/// Up to eight bytes as a number, the first the lowest.
uint64_t little_endian(const char* bytes, size_t count) {
    uint64_t value = 0;
    if constexpr (std::endian::native == std::endian::little) {
        std::memcpy(&value, bytes, count);
    } else {
        for (size_t i = 0; i < count; ++i) value |= static_cast<uint64_t>(static_cast<uint8_t>(bytes[i])) << (8 * i);
    }
    return value;
}

}  // namespace

uint64_t hash_text(std::string_view text, uint64_t seed) {
    uint64_t hash = 0xCBF29CE484222325ull ^ (seed * 0x9E3779B97F4A7C15ull);  // FNV-1a
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
    hash ^= hash >> 32;
    hash *= 0xD6E8FEB86659FD93ull;
    return hash ^ (hash >> 32);
}

SipHash::SipHash(std::array<uint64_t, 2> key)
    : a_(key[0] ^ 0x736f6d6570736575ull),
      b_(key[1] ^ 0x646f72616e646f6dull),
      c_(key[0] ^ 0x6c7967656e657261ull),
      d_(key[1] ^ 0x7465646279746573ull) {}

void SipHash::round() {
    a_ += b_;
    c_ += d_;
    b_ = std::rotl(b_, 13) ^ a_;
    d_ = std::rotl(d_, 16) ^ c_;
    a_ = std::rotl(a_, 32);
    c_ += b_;
    a_ += d_;
    b_ = std::rotl(b_, 17) ^ c_;
    d_ = std::rotl(d_, 21) ^ a_;
    c_ = std::rotl(c_, 32);
}

void SipHash::word(uint64_t value) {
    d_ ^= value;
    round();
    round();
    a_ ^= value;
}

uint64_t SipHash::finish(uint64_t last) {
    word(last);
    c_ ^= 0xFF;
    for (int i = 0; i < 4; ++i) round();
    return a_ ^ b_ ^ c_ ^ d_;
}

Fingerprinter::Fingerprinter() : hash_({0x706f7274746f6f6cull, 0x6e6f726d616c2032ull}) {}  // "porttool", "normal 2"

/// Every text fills whole words, its length in the first byte, so that `a b` and `ab` differ.
void Fingerprinter::add(std::string_view text) {
    constexpr size_t kLong = 0xFF, kBeside = kWord - 1;
    const size_t size = text.size();
    const size_t first = std::min(size, kBeside);
    if (size >= kLong) hash_.word(size);
    hash_.word(little_endian(text.data(), first) << 8 | std::min(size, kLong));
    for (size_t at = first; at < size; at += kWord)
        hash_.word(little_endian(text.data() + at, std::min(size - at, kWord)));
}

std::string Fingerprinter::digits() const {
    SipHash copy = hash_;
    return hexadecimal(copy.finish(0));
}

bool is_fingerprint(std::string_view text) {
    return text.size() == kDigits && std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
           });
}

std::string fingerprint_of_version_1(const std::vector<std::string>& words) {
    uint64_t hash = 0;
    for (const std::string& word : words) hash = hash_text(word, hash + 1);
    return hexadecimal(hash);
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/text/fingerprint.h"

#include <algorithm>
#include <cstdio>

namespace metrics {
namespace {

constexpr size_t kWord = sizeof(uint64_t);

template <class T>
uint64_t load(const char* bytes) {
    T value = 0;
    for (size_t i = 0; i < sizeof(T); ++i)  // one load where the machine is little-endian
        value = static_cast<T>(value | static_cast<T>(static_cast<T>(static_cast<uint8_t>(bytes[i])) << (8 * i)));
    return value;
}

/// Up to eight bytes as a number, the first the lowest. Loads that overlap in place of a loop.
inline uint64_t little_endian(const char* bytes, size_t count) {
    if (count == kWord) return load<uint64_t>(bytes);
    if (count >= 4) return load<uint32_t>(bytes) | load<uint32_t>(bytes + count - 4) << (8 * (count - 4));
    if (count >= 2) return load<uint16_t>(bytes) | load<uint8_t>(bytes + count - 1) << (8 * (count - 1));
    return count == 1 ? load<uint8_t>(bytes) : 0;
}

}  // namespace

SipHash::SipHash(std::array<uint64_t, 2> key)
    : a_(key[0] ^ 0x736f6d6570736575ull),
      b_(key[1] ^ 0x646f72616e646f6dull),
      c_(key[0] ^ 0x6c7967656e657261ull),
      d_(key[1] ^ 0x7465646279746573ull) {}

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

uint64_t Fingerprinter::bits() const {
    SipHash copy = hash_;
    return std::max<uint64_t>(copy.finish(0), 1);  // nothing is what has no print
}

std::string Fingerprinter::digits() const {
    std::array<char, 2 * kWord + 1> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(bits()));
    return text.data();
}

std::string plain_text(std::string_view file, std::vector<uint32_t>* splices) {
    if (file.starts_with("\xEF\xBB\xBF")) file.remove_prefix(3);
    std::string text;
    text.reserve(file.size() + 1);
    size_t backslash = 0, carriage_return = 0;  // the next ones from `i`
    for (size_t i = 0; i < file.size(); ++i) {
        const size_t first = i;
        if (backslash <= i) backslash = std::min(file.find('\\', i), file.size());
        if (carriage_return <= i) carriage_return = std::min(file.find('\r', i), file.size());
        i = std::min(backslash, carriage_return);
        text.append(file, first, i - first);
        if (i == file.size()) break;
        char c = file[i];
        if (c == '\\') {
            size_t next = i + 1;
            if (next < file.size() && file[next] == '\r') ++next;
            if (next < file.size() && file[next] == '\n') {
                if (splices != nullptr) splices->push_back(static_cast<uint32_t>(text.size()));
                i = next;
                continue;
            }
        }
        if (c == '\r') {
            if (i + 1 < file.size() && file[i + 1] == '\n') continue;
            c = '\n';
        }
        text.push_back(c);
    }
    return text;
}

}  // namespace metrics

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What the texts of a program are known by, to the gate and to the programs that ran them.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace metrics {

/// SipHash-2-4 (Aumasson and Bernstein 2012). The key is known to all; what it buys is that nobody finds another text
/// for a given print with less than some 2^64 tries, as anybody could for a simpler hash, and so slip an edit past the
/// gate.
class SipHash {
public:
    explicit SipHash(std::array<uint64_t, 2> key);
    /// Takes in eight bytes, the first the lowest.
    void word(uint64_t value) {
        d_ ^= value;
        round();
        round();
        a_ ^= value;
    }
    /// The hash. `last`: the bytes that make no word, and in the highest byte the length of all modulo 256. Ends the
    /// object's life.
    uint64_t finish(uint64_t last);

private:
    void round() {
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

    uint64_t a_, b_, c_, d_;
};

/// 64 bits over texts in their order, never all zero; as a text 16 hexadecimal digits.
class Fingerprinter {
public:
    Fingerprinter();
    void add(std::string_view text);
    uint64_t bits() const;
    std::string digits() const;

private:
    SipHash hash_;
};

/// A file's text as its prints are taken: without byte order mark and carriage returns, lines that end in a backslash
/// joined to the next. `splices`, where given, gets the places in the result where lines were joined.
std::string plain_text(std::string_view file, std::vector<uint32_t>* splices = nullptr);

}  // namespace metrics

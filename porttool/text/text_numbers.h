// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace porttool {

/// Numbers texts from 0 in the order in which they come, and keeps them. A large file has a million different words,
/// and each lookup lands anywhere in the table, so that is as small as can be: four bytes a slot, what else is known of
/// a text stands by its number, in the order in which texts come and mostly are asked for again. Throws
/// std::length_error from 2^26 - 1 texts on.
class TextNumbers {
public:
    static constexpr uint32_t kNone = 0xFFFFFFFFu;

    /// The number of a text; one that is new gets size().
    uint32_t number(std::string_view text);
    /// kNone for a text that has no number.
    uint32_t find(std::string_view text) const;
    bool contains(std::string_view text) const { return find(text) != kNone; }
    /// The text of a number; valid as long as the table is there.
    std::string_view text(uint32_t number) const { return texts_[number]; }
    uint32_t size() const { return static_cast<uint32_t>(texts_.size()); }

private:
    static uint32_t hash_of(std::string_view text);
    /// Where the text stands, or the free slot that it may take.
    size_t place(std::string_view text, uint32_t hash) const;
    void grow();
    std::string_view kept(std::string_view text);

    std::vector<uint32_t> slots_;  ///< a power of two; a number under some bits of the hash, or kNone
    std::vector<uint32_t> hashes_;
    std::vector<std::string_view> texts_;
    std::vector<std::unique_ptr<char[]>> blocks_;  ///< what texts_ shows
    char* next_ = nullptr;                         ///< free bytes of the last block
    size_t left_ = 0;
};

}  // namespace porttool

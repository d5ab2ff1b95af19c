// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/text_numbers.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <stdexcept>

namespace porttool {
namespace {

constexpr uint32_t kNumber = (1u << 26) - 1, kHash = ~kNumber;  // of the bits of a slot

}  // namespace

uint32_t TextNumbers::number(std::string_view text) {
    if (3 * (texts_.size() + 1) > 2 * slots_.size()) grow();
    const uint32_t hash = hash_of(text);
    uint32_t& slot = slots_[place(text, hash)];
    if (slot == kNone) {
        if (size() >= kNumber) throw std::length_error("more different words than porttool can number");
        slot = (hash & kHash) | size();
        hashes_.push_back(hash);
        texts_.push_back(kept(text));
    }
    return slot & kNumber;
}

uint32_t TextNumbers::find(std::string_view text) const {
    if (slots_.empty()) return kNone;
    const uint32_t slot = slots_[place(text, hash_of(text))];
    return slot == kNone ? kNone : slot & kNumber;
}

uint32_t TextNumbers::hash_of(std::string_view text) {
    const uint64_t hash = std::hash<std::string_view>()(text);
    return static_cast<uint32_t>(hash ^ (hash >> 32));
}

size_t TextNumbers::place(std::string_view text, uint32_t hash) const {
    const size_t mask = slots_.size() - 1;
    for (size_t at = hash & mask;; at = (at + 1) & mask) {
        const uint32_t slot = slots_[at];
        if (slot == kNone || ((slot ^ hash) <= kNumber && texts_[slot & kNumber] == text)) return at;
    }
}

void TextNumbers::grow() {
    constexpr size_t kFirst = 32;
    slots_ = std::vector<uint32_t>(slots_.empty() ? kFirst : 2 * slots_.size(), kNone);
    const size_t mask = slots_.size() - 1;
    for (uint32_t number = 0; number < size(); ++number) {
        size_t at = hashes_[number] & mask;
        while (slots_[at] != kNone) at = (at + 1) & mask;
        slots_[at] = (hashes_[number] & kHash) | number;
    }
}

std::string_view TextNumbers::kept(std::string_view text) {
    constexpr size_t kSmallest = 256, kLargest = 1 << 16;
    if (text.size() > left_) {
        left_ = std::max(text.size(), std::min(kLargest, kSmallest << std::min<size_t>(blocks_.size(), 8)));
        blocks_.push_back(std::make_unique<char[]>(left_));
        next_ = blocks_.back().get();
    }
    if (!text.empty()) std::memcpy(next_, text.data(), text.size());
    const std::string_view copy(next_, text.size());
    next_ += text.size();
    left_ -= text.size();
    return copy;
}

}  // namespace porttool

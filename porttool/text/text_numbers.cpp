// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/text_numbers.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <utility>

namespace porttool {

uint32_t TextNumbers::number(std::string_view text) {
    if (2 * (texts_.size() + 1) > slots_.size()) grow();
    const uint32_t hash = hash_of(text);
    Slot& slot = slots_[place(text, hash)];
    if (slot.number == kNone) {
        slot = {hash, size()};
        texts_.push_back(kept(text));
    }
    return slot.number;
}

uint32_t TextNumbers::find(std::string_view text) const {
    return slots_.empty() ? kNone : slots_[place(text, hash_of(text))].number;
}

uint32_t TextNumbers::hash_of(std::string_view text) {
    const uint64_t hash = std::hash<std::string_view>()(text);
    return static_cast<uint32_t>(hash ^ (hash >> 32));
}

size_t TextNumbers::place(std::string_view text, uint32_t hash) const {
    const size_t mask = slots_.size() - 1;
    for (size_t at = hash & mask;; at = (at + 1) & mask) {
        const Slot& slot = slots_[at];
        if (slot.number == kNone || (slot.hash == hash && texts_[slot.number] == text)) return at;
    }
}

void TextNumbers::grow() {
    constexpr size_t kFirst = 32;
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(slots_.empty() ? kFirst : 2 * slots_.size()));
    const size_t mask = slots_.size() - 1;
    for (const Slot& slot : old) {
        if (slot.number == kNone) continue;
        size_t at = slot.hash & mask;
        while (slots_[at].number != kNone) at = (at + 1) & mask;
        slots_[at] = slot;
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

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace porttool {

/// Remembers a number for each of many 64-bit keys, in one flat table. A large text has a million of them, and a table
/// of nodes would miss the processor's caches several times at each step.
class KeyNumbers {
public:
    /// The number of a key; a key that is new gets `next`.
    uint32_t number(uint64_t key, uint32_t next) {
        if (2 * (used_ + 1) > slots_.size()) grow();
        Slot& slot = place(key);
        if (slot.number == kFree) {
            slot = {key, next};
            ++used_;
        }
        return slot.number;
    }

private:
    static constexpr uint32_t kFree = 0xFFFFFFFFu;
    struct Slot {
        uint64_t key = 0;
        uint32_t number = kFree;
    };

    /// Where the key stands, or the free slot that it may take.
    Slot& place(uint64_t key) {
        const size_t mask = slots_.size() - 1;
        uint64_t at = key * 0x9E3779B97F4A7C15ull;
        for (at ^= at >> 32;; ++at) {
            Slot& slot = slots_[at & mask];
            if (slot.number == kFree || slot.key == key) return slot;
        }
    }

    void grow() {
        constexpr size_t kFirst = 1024;
        const std::vector<Slot> old =
            std::exchange(slots_, std::vector<Slot>(slots_.empty() ? kFirst : 2 * slots_.size()));
        for (const Slot& slot : old)
            if (slot.number != kFree) place(slot.key) = slot;
    }

    std::vector<Slot> slots_;  ///< a power of two
    size_t used_ = 0;
};

}  // namespace porttool

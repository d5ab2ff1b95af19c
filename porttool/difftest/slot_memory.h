// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace porttool {

/// Slots of 8 bytes that a process of ours reads or writes as a file, though they are on no disk.
class SlotMemory {
public:
    SlotMemory() = default;
    ~SlotMemory();
    SlotMemory(const SlotMemory&) = delete;
    SlotMemory& operator=(const SlotMemory&) = delete;

    /// Makes it that many slots, whatever they hold: what it had before is kept and used again where it is enough.
    /// False where there is no memory for them.
    bool resize(size_t slots);
    std::span<uint64_t> slots() const { return {slots_, count_}; }
    /// By this path a process of the same user opens it, as long as this one lives.
    std::string path() const;

private:
    void close();

    int file_ = -1;
    uint64_t* slots_ = nullptr;
    size_t count_ = 0, room_ = 0;
};

}  // namespace porttool

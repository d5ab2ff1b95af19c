// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/slot_memory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>

namespace porttool {

SlotMemory::~SlotMemory() { close(); }

void SlotMemory::close() {
    if (slots_ != nullptr) (void)::munmap(slots_, room_ * sizeof(uint64_t));
    if (file_ >= 0) (void)::close(file_);
    file_ = -1;
    slots_ = nullptr;
    count_ = room_ = 0;
}

bool SlotMemory::resize(size_t slots) {
    if (slots_ != nullptr && slots <= room_) {
        count_ = slots;
        return true;
    }
    close();
    file_ = ::memfd_create("slots", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    const size_t room = std::max<size_t>(1, slots), bytes = room * sizeof(uint64_t);
    // Sealed, for what runs on it may do anything, and reading what was cut off would end this program.
    if (file_ < 0 || ::ftruncate(file_, static_cast<off_t>(bytes)) != 0 ||
        ::fcntl(file_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW) != 0)
        return false;
    void* const at = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
    if (at == MAP_FAILED) return false;
    slots_ = static_cast<uint64_t*>(at);
    count_ = slots;
    room_ = room;
    return true;
}

std::string SlotMemory::path() const { return fmt::format("/proc/{}/fd/{}", ::getpid(), file_); }

}  // namespace porttool

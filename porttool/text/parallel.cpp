// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/parallel.h"

#include <sys/mman.h>

namespace porttool {

bool threads_have_room() {
    constexpr size_t kRoom = size_t{1} << 30;
    void* const room = ::mmap(nullptr, kRoom, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) return false;
    (void)::munmap(room, kRoom);
    return true;
}

}  // namespace porttool

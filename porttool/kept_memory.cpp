// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// How much free memory jemalloc keeps for what is asked for next. By itself it gives each free piece of 8 MiB back to
// the system at once, and the tables of one large file then cost a page fault for every page each time one is made,
// more for each byte the larger the file is. With more than 16 MiB the peak grows faster than the time falls.
#include <cstddef>

extern "C" {
extern const char* malloc_conf;
const char* malloc_conf = "oversize_threshold:16777216";
/// Weak: a program whose memory is a sanitizer's is linked without jemalloc.
[[gnu::weak]] int mallctl(const char* name, void* old_value, size_t* old_size, void* new_value, size_t new_size);
}

namespace {

/// The arena of the first thread is made before the setting is read, and has to be told.
bool tell_first_arena() {
    size_t most = size_t{16} << 20;
    return mallctl != nullptr && ::mallctl("arena.0.oversize_threshold", nullptr, nullptr, &most, sizeof most) == 0;
}

[[maybe_unused]] const bool kTold = tell_first_arena();

}  // namespace

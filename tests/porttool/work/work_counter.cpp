// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/porttool/work/work_counter.h"

#include <cstdlib>
#include <new>

namespace {
porttool::testing::Work work;
}

// The compiler calls this at the start of each stretch of code without a branch. One thread does all the work here.
extern "C" void __sanitizer_cov_trace_pc() { ++work.steps; }

void* operator new(std::size_t size) {
    work.allocated += size;
    if (void* block = std::malloc(size > 0 ? size : 1)) return block;
    throw std::bad_alloc();
}

void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace porttool::testing {

Work work_so_far() { return work; }

}  // namespace porttool::testing

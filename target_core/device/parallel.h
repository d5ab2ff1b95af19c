// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <thread>
#include <vector>

#include "target_core/device/glsl.h"

namespace target_core {

/// Calls body(i) for every i below `count`, on all threads of the current task arena, in any order.
template <class Body>
void for_each_tile(uint count, const Body& body) {
#ifdef __SANITIZE_THREAD__
    // The sanitizer cannot see into the TBB library and takes every hand-over of a task for a race. Plain threads do
    // the same work there, so that what the tiles share is still looked at.
    std::atomic<uint> next{0};
    auto work = [&] {
        for (uint i = next++; i < count; i = next++) body(i);
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < tbb::this_task_arena::max_concurrency(); ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
#else
    tbb::parallel_for(
        tbb::blocked_range<uint>(0, count, 1),
        [&](const tbb::blocked_range<uint>& range) {
            for (uint i = range.begin(); i < range.end(); ++i) body(i);
        },
        tbb::simple_partitioner());
#endif
}

}  // namespace target_core

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace porttool {

/// From so many files on, threads pay for their start.
constexpr size_t kFilesWorthThreads = 64;

/// Calls work(i) for each i below `count`, on all cores where `worthwhile` says that starting threads pays, in any
/// order. What the first call to fail throws is thrown on, after all have ended.
template <class Work>
void in_parallel(size_t count, bool worthwhile, const Work& work) {
    std::atomic<size_t> next{0};
    std::exception_ptr failure;
    std::mutex mutex;
    const auto run = [&] {
        try {
            for (size_t i = next++; i < count; i = next++) work(i);
        } catch (...) {
            next = count;
            const std::lock_guard lock(mutex);
            if (!failure) failure = std::current_exception();
        }
    };
    constexpr size_t kMostThreads = 16;
    // To count the cores is to read a file: not for what is done before that is.
    const size_t cores = worthwhile ? std::clamp<size_t>(std::thread::hardware_concurrency(), 1, kMostThreads) : 1;
    std::vector<std::thread> threads;
    try {
        for (size_t i = 1; i < std::min(cores, count); ++i) threads.emplace_back(run);
    } catch (const std::system_error&) {
        // as where a container allows no more threads
    }
    run();
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace porttool

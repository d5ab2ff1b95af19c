// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <future>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace porttool {

/// From so many files on, threads pay for their start.
constexpr size_t kFilesWorthThreads = 64;

/// False where memory is limited (`ulimit -v`) so that starting threads could use it up: a thread that cannot have the
/// tables of its allocator ends the program by a signal, not by an exception. Asks for a GiB, and does not touch it.
bool threads_have_room();

/// How std::async is to do what is worth a thread of its own: at once, or, where no thread can be had, when its result
/// is asked for.
inline std::launch in_a_thread_if(bool worthwhile) {
    return worthwhile && threads_have_room() ? std::launch::async | std::launch::deferred : std::launch::deferred;
}

/// Calls work(i, memory) for each i below `count`, on all cores where `worthwhile` says that starting threads pays, in
/// any order; `memory` is a Memory that no other thread has. What the first call to fail throws is thrown on, after all
/// have ended.
template <class Memory, class Work>
void in_parallel_with(size_t count, bool worthwhile, const Work& work) {
    std::atomic<size_t> next{0};
    std::exception_ptr failure;
    std::mutex mutex;
    const auto run = [&] {
        try {
            Memory memory;
            for (size_t i = next++; i < count; i = next++) work(i, memory);
        } catch (...) {
            next = count;
            const std::lock_guard lock(mutex);
            if (!failure) failure = std::current_exception();
        }
    };
    constexpr size_t kMostThreads = 16;
    // To count the cores is to read a file: not for what is done before that is.
    const bool at_once = worthwhile && count > 1 && threads_have_room();
    const size_t cores = at_once ? std::clamp<size_t>(std::thread::hardware_concurrency(), 1, kMostThreads) : 1;
    std::vector<std::thread> threads;
    try {
        threads.reserve(cores);
        for (size_t i = 1; i < std::min(cores, count); ++i) threads.emplace_back(run);
    } catch (const std::exception&) {
        // as where a container allows no more threads
    }
    run();
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
}

/// The same for work(i), which needs no memory of its thread's own.
template <class Work>
void in_parallel(size_t count, bool worthwhile, const Work& work) {
    struct None {};
    in_parallel_with<None>(count, worthwhile, [&](size_t i, None&) { work(i); });
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <string>

namespace porttool {

/// Bounds what a compiler that runs within this process may take, while it lives: forty lines of macros are enough to
/// keep one busy for years. Beyond its time the process ends with exit code 2 and a line that names the file; beyond
/// its memory std::bad_alloc is thrown. One at a time.
class CompileLimit {
public:
    static constexpr uint64_t kMostMemory = 2ull << 30;  ///< bytes of address space

    explicit CompileLimit(const std::string& file);
    ~CompileLimit();
    CompileLimit(const CompileLimit&) = delete;
    CompileLimit& operator=(const CompileLimit&) = delete;

    /// Processor time for one file, and what is left for all of a run; tests set them.
    static std::chrono::milliseconds& most_time();
    static std::chrono::milliseconds& left_in_all();

private:
    std::chrono::milliseconds time_;
    struct sigaction before_ = {};
    rlimit memory_before_ = {};
    bool has_memory_ = false;
};

}  // namespace porttool

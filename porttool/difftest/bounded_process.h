// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace porttool {

/// What a process may use.
struct ProcessLimits {
    std::chrono::milliseconds time{20000};
    uint64_t memory = 1ull << 30;  ///< bytes of address space
    uint64_t file = 1ull << 30;    ///< bytes of one file that it writes
    size_t output = 1 << 20;       ///< bytes of its output that are kept, the first ones
};

/// How a process ended.
struct ProcessEnd {
    int exit_code = 0;  ///< 127 where it could not be started, 128 and the signal's number where one killed it
    bool timed_out = false;
    std::string output;  ///< stdout and stderr as they came
};

/// Runs a program by its path with these arguments, never a shell, in a folder, with nothing on its stdin and a plain
/// environment. It and all that it started end with it, also what made itself a session of its own, and with its time.
ProcessEnd run_process(const std::vector<std::string>& arguments, const std::string& folder,
                       const ProcessLimits& limits);

/// The path of a program that PATH has; "" for none.
std::string program_path(const std::string& name);

/// Ends every program that runs by run_process(), for one that ends itself.
void end_processes();

}  // namespace porttool

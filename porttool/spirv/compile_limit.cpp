// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/spirv/compile_limit.h"

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

std::string message_at_end;  // made before the clock runs: a signal handler may not allocate

extern "C" void end_of_compile_time(int) {
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message_at_end.data(), message_at_end.size());
    _exit(2);
}

itimerval timer_of(std::chrono::milliseconds time) {
    constexpr int64_t kThousand = 1000;
    itimerval out = {};
    out.it_value.tv_sec = time.count() / kThousand;
    out.it_value.tv_usec = time.count() % kThousand * kThousand;
    return out;
}

/// Bytes of address space that the process has; 0 where nothing tells.
uint64_t address_space() {
    uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

std::chrono::milliseconds& CompileLimit::most_time() {
    static std::chrono::milliseconds time = std::chrono::minutes(1);
    return time;
}

std::chrono::milliseconds& CompileLimit::left_in_all() {
    static std::chrono::milliseconds time = std::chrono::minutes(10);
    return time;
}

CompileLimit::CompileLimit(const std::string& file)
    : time_(std::max(std::chrono::milliseconds(1), std::min(most_time(), left_in_all()))) {
    message_at_end = "porttool: --spirv: " + terminal_text(file) +
                     " takes too much processor time to compile (60 s for one file, 10 minutes in all); check without "
                     "--spirv, or look what it does\n";
    const uint64_t now = address_space();
    has_memory_ = now > 0 && getrlimit(RLIMIT_AS, &memory_before_) == 0;
    if (has_memory_) {
        rlimit bounded = memory_before_;
        bounded.rlim_cur = std::min<rlim_t>(memory_before_.rlim_cur, now + kMostMemory);
        has_memory_ = setrlimit(RLIMIT_AS, &bounded) == 0;
    }
    struct sigaction act = {};
    act.sa_handler = end_of_compile_time;
    sigaction(SIGPROF, &act, &before_);
    const itimerval timer = timer_of(time_);
    setitimer(ITIMER_PROF, &timer, nullptr);
}

CompileLimit::~CompileLimit() {
    const itimerval off = {};
    itimerval rest = {};
    setitimer(ITIMER_PROF, &off, &rest);
    constexpr int64_t kThousand = 1000;
    left_in_all() -=
        time_ - std::chrono::milliseconds(rest.it_value.tv_sec * kThousand + rest.it_value.tv_usec / kThousand);
    sigaction(SIGPROF, &before_, nullptr);
    if (has_memory_) setrlimit(RLIMIT_AS, &memory_before_);
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/child_process.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace porttool {

int exit_code_of(int status) {
    constexpr int kSignalled = 128;
    return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
}

bool take_available(int pipe, const std::function<void(std::string_view)>& take) {
    constexpr int kMostReads = 16;  // who prints without end must not keep the caller from looking at the clock
    std::array<char, 65536> buffer;
    for (int i = 0; i < kMostReads; ++i) {
        const ssize_t got = ::read(pipe, buffer.data(), buffer.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return got < 0 && errno == EAGAIN;
        take({buffer.data(), static_cast<size_t>(got)});
    }
    return true;
}

}  // namespace porttool

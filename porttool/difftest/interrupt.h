// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <thread>

namespace porttool {

/// While it lives, a Ctrl-C, SIGTERM or SIGHUP first cleans up, then ends this program with 128 and the signal's
/// number. Made before any other thread, so that no other takes the signal.
class CleanOnInterrupt {
public:
    explicit CleanOnInterrupt(std::function<void()> clean);
    ~CleanOnInterrupt();
    CleanOnInterrupt(const CleanOnInterrupt&) = delete;
    CleanOnInterrupt& operator=(const CleanOnInterrupt&) = delete;

private:
    sigset_t watched_{}, before_{};
    std::atomic<bool> over_ = false;
    std::thread waiter_;
};

}  // namespace porttool

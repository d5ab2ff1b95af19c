// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include <ctime>
#include <utility>

namespace porttool {

CleanOnInterrupt::CleanOnInterrupt(std::function<void()> clean) {
    (void)::sigemptyset(&watched_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        // Who asked for a signal to be ignored, as nohup does, has it ignored.
        if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN)
            (void)::sigaddset(&watched_, signal);
    }
    (void)::pthread_sigmask(SIG_BLOCK, &watched_, &before_);
    waiter_ = std::thread([this, clean = std::move(clean)] {
        constexpr timespec kTurn{0, 50'000'000};
        while (!over_) {
            const int signal = ::sigtimedwait(&watched_, nullptr, &kTurn);
            if (signal <= 0) continue;
            clean();
            constexpr int kSignalled = 128;
            ::_exit(kSignalled + signal);
        }
    });
}

CleanOnInterrupt::~CleanOnInterrupt() {
    over_ = true;
    waiter_.join();
    (void)::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace porttool

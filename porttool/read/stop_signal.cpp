// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/stop_signal.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

namespace porttool {
namespace {

volatile std::sig_atomic_t g_signal = 0;
volatile std::sig_atomic_t g_event = -1;

void note_signal(int signal) {
    const int error = errno;
    g_signal = signal;
    const uint64_t one = 1;
    (void)!::write(g_event, &one, sizeof one);
    errno = error;
}

/// The handler is taken back when it runs, so that a second signal does what it always does.
void handle(int signal, struct sigaction& before) {
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    (void)::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) (void)::sigaction(signal, &action, nullptr);
}

}  // namespace

StopSignal::StopSignal() {
    g_signal = 0;
    g_event = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    handle(SIGINT, interrupt_);
    handle(SIGTERM, terminate_);
}

StopSignal::~StopSignal() {
    (void)::sigaction(SIGINT, &interrupt_, nullptr);
    (void)::sigaction(SIGTERM, &terminate_, nullptr);
    (void)::close(g_event);
    g_event = -1;
}

int StopSignal::descriptor() const { return g_event; }

int StopSignal::exit_code() const {
    constexpr int kSignalled = 128;
    return g_signal == 0 ? 0 : kSignalled + g_signal;
}

}  // namespace porttool

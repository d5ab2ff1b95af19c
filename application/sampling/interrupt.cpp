// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/interrupt.h"

#include <atomic>
#include <csignal>

#include "application/file_output.h"

namespace application {
namespace {

constexpr int kKept[] = {SIGINT, SIGTERM, SIGHUP};

std::atomic<int> kept_signal = 0;  // read by threads other than the one that is interrupted
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void keep_first_signal(int number) {
    // A terminal that closes sends SIGHUP, and its shell often another one: nobody has asked twice.
    if (kept_signal != 0 && number == SIGHUP) return;
    if (kept_signal != 0) remove_unfinished_file_and_end(number);
    kept_signal = number;
}

void handle(int number, void (*handler)(int)) {
    struct sigaction now {};
    if (sigaction(number, nullptr, &now) != 0 || now.sa_handler == SIG_IGN) return;
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigaction(number, &action, nullptr);
}

}  // namespace

KeptInterrupt::KeptInterrupt() {
    kept_signal = 0;
    for (const int number : kKept) handle(number, keep_first_signal);
}

KeptInterrupt::~KeptInterrupt() {
    for (const int number : kKept) handle(number, remove_unfinished_file_and_end);
}

int KeptInterrupt::signal() const { return kept_signal; }

const char* name_of_signal(int number) { return number == SIGINT ? "Ctrl-C" : number == SIGHUP ? "SIGHUP" : "SIGTERM"; }

ExitCode exit_code_of_signal(int number) {
    return number == SIGINT ? INTERRUPTED : number == SIGHUP ? HUNG_UP : TERMINATED;
}

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "porttool/command/run.h"

namespace {

/// A standard stream that is closed would lend its number to the next file that is opened, and what is said would be
/// written into that. What cannot be written to takes its place.
void hold_standard_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
            return;
}

/// A write beyond what a file may hold (`ulimit -f`) is an error with a line, not the end on the spot with files left
/// behind. A handler, not SIG_IGN: programs that are started do not inherit it.
void take_full_files_for_errors() {
    struct sigaction action {};
    action.sa_handler = [](int) {};
    action.sa_flags = SA_RESTART;
    (void)::sigaction(SIGXFSZ, &action, nullptr);
}

}  // namespace

int main(int argc, char** argv) try {
    hold_standard_streams();
    take_full_files_for_errors();
    porttool::RealDisk disk;
    return porttool::run_porttool(argc, argv, disk, std::cout, std::cerr);
} catch (...) {  // what even the message of an error could not be made of
    std::fputs("porttool: not enough memory\n", stderr);
    return 2;
}

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
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

}  // namespace

int main(int argc, char** argv) try {
    hold_standard_streams();
    porttool::RealDisk disk;
    return porttool::run_porttool(argc, argv, disk, std::cout, std::cerr);
} catch (...) {  // what even the message of an error could not be made of
    std::fputs("porttool: not enough memory\n", stderr);
    return 2;
}

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

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

/// What is thrown where nothing may be, as by a destructor that finds no memory, ends as any other error does. Nothing
/// is tidied up: the next run does that, as after one that was killed.
[[noreturn]] void end_with_a_line() {
    const char* line = "porttool: stopped by an error of its own; please report it\n";
    if (const std::exception_ptr thrown = std::current_exception()) try {
            std::rethrow_exception(thrown);
        } catch (const std::bad_alloc&) {
            line = "porttool: not enough memory\n";
        } catch (...) {
        }
    std::fputs(line, stderr);
    ::_exit(2);
}

}  // namespace

int main(int argc, char** argv) try {
    std::set_terminate(end_with_a_line);
    hold_standard_streams();
    take_full_files_for_errors();
    porttool::RealDisk disk;
    return porttool::run_porttool(argc, argv, disk, std::cout, std::cerr);
} catch (...) {  // what even the message of an error could not be made of
    std::fputs("porttool: not enough memory\n", stderr);
    return 2;
}

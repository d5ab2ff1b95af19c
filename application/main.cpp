// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "application/program.h"

namespace {

/// mpirun says to each process how many there are. Then pathtracer-mpi, which is built where MPI is found, takes over;
/// without it there would be N programs that write one file.
bool hands_over(char** argv) {
    const char* processes = std::getenv("OMPI_COMM_WORLD_SIZE");
    if (processes == nullptr || std::strtol(processes, nullptr, 10) < 2) return true;
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::string other = (program.parent_path() / "pathtracer-mpi").string();
    if (!error) execv(other.c_str(), argv);
    std::fprintf(stderr,
                 "pathtracer: error: mpirun started %s processes, but %s is not there: build it where MPI is found "
                 "(Debian: libopenmpi-dev), see docs/cluster.md\n",
                 processes, other.c_str());
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    if (!hands_over(argv)) return 2;
    const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
    return application::run_program(arguments);
}

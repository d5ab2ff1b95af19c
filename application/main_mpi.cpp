// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// pathtracer-mpi: the program with its ranks as a team. Beside pathtracer, which hands over to it under mpirun, so that
// nobody else needs MPI.
#include <mpi.h>

#include <string>
#include <vector>

#include "application/cluster/mpi_team.h"
#include "application/program.h"

int main(int argc, char** argv) {
    int threads = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &threads);
    const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
    int code = 0;
    {
        application::MpiTeam team;
        application::set_team(&team);
        code = application::run_program(arguments);
        application::set_team(nullptr);
    }
    MPI_Finalize();
    return code;
}

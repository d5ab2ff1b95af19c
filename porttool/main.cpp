// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <iostream>

#include "porttool/command/run.h"

// Read by jemalloc, where porttool is linked with it: large pages spare a large project a tenth of its time.
extern "C" {
extern const char* malloc_conf;
const char* malloc_conf = "thp:always";
}

int main(int argc, char** argv) try {
    porttool::RealDisk disk;
    return porttool::run_porttool(argc, argv, disk, std::cout, std::cerr);
} catch (...) {  // what even the message of an error could not be made of
    std::fputs("porttool: not enough memory\n", stderr);
    return 2;
}

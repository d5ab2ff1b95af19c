// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <iostream>

#include "porttool/command/run.h"

int main(int argc, char** argv) try {
    porttool::RealDisk disk;
    return porttool::run_porttool(argc, argv, disk, std::cout, std::cerr);
} catch (...) {  // what even the message of an error could not be made of
    std::fputs("porttool: not enough memory\n", stderr);
    return 2;
}

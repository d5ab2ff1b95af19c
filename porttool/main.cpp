// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <iostream>

#include "porttool/command/commands.h"

int main(int argc, char** argv) {
    porttool::RealDisk disk;
    return porttool::run_porttool(argc, argv, disk, std::cout, std::cerr);
}

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// One of several ports that lie side by side in the target.
struct PortFiles {
    std::string name;             ///< the folder, or the word of a path, that tells it from the others
    std::vector<uint32_t> files;  ///< numbers of the target's files; what belongs to no port is in each
};

/// Whether the target holds the same source several times over, and where each port lies: in a folder of its own
/// (`src/cuda/`, `src/omp/`), in folders or files with a word of its own (`sort-cuda/`, `scan-cuda/`, `AXPY-OMP.cpp`).
/// It is told by names that the source has once and each of these places has again. Empty where there is but one port:
/// modules have each their own names, and so have the programs of a collection, as often as the source has them.
std::vector<PortFiles> find_ports(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target);

}  // namespace porttool

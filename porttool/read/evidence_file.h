// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What programs that ran both sides wrote down; docs/evidence.md has the form of the file.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "porttool/read/disk.h"
#include "porttool/scan/side.h"

namespace porttool {

/// A pair whose functions ran on the same inputs.
struct SeenPair {
    BySide<std::string> id;
    bool same = true;
    std::string example;       ///< `for x = 1: 2, 3`; "" where there is none
    std::string example_json;  ///< the counterexample as it stands in the file
};

/// A kernel in which two pictures part.
struct SeenKernel {
    std::string name, field;
    BySide<std::string> entry;  ///< the ids of its entry functions; "" where the file does not say
    uint64_t segment = 0;       ///< of the path, 1 for the ray of the camera; 0 where the file does not say
    uint64_t paths = 0;
    double share = 0;  ///< of all paths
    std::vector<std::string> materials;
    std::optional<std::array<uint64_t, 2>> pixel;
    std::optional<double> ssim;
    std::vector<std::string> pictures;  ///< beneath the folder of the file
};

/// One file of evidence.
struct EvidenceFile {
    std::string path;
    std::vector<std::pair<std::string, std::string>> texts;  ///< what ran: the file and the print of its text
    std::vector<SeenPair> pairs;                             ///< those that ran
    std::vector<SeenKernel> kernels;                         ///< in the order in which they parted
};

/// Reads a file that `difftest --evidence` or `compare --locate --evidence` wrote. Throws CannotDo.
EvidenceFile read_evidence(const std::string& path, const Disk& disk);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "porttool/difftest/leaves.h"
#include "porttool/scan/side.h"
#include "porttool/snapshot/project.h"

namespace porttool {

/// How functions are run.
struct DifftestSettings {
    size_t inputs = 100000;  ///< records a pair
    int ulps = 4;            ///< 0: to the bit
    uint64_t seed = 1;
    std::vector<std::string> defines;  ///< NAME or NAME=VALUE, for every file
    std::string keep;                  ///< a folder for the programs and their texts, which stay there; "" for none
};

/// A number as it went in or came out: a real, or a whole number.
struct SeenNumber {
    std::string path;
    bool is_real = true;
    bool is_single = true;  ///< a real that a float holds
    double real = 0;
    int64_t whole = 0;
};

/// An input on which the two sides part, and what each gives where they first do.
struct Counterexample {
    std::vector<SeenNumber> inputs;
    BySide<SeenNumber> results;
};

enum class DifftestState : uint8_t { Same, Differs, NotRun };

/// What became of a pair.
struct DifftestPair {
    std::string source, target;
    DifftestState state = DifftestState::NotRun;
    size_t inputs = 0;      ///< on which both sides gave an answer
    std::string tolerance;  ///< "bits", "4 ulps"; "" where it did not run
    std::optional<Counterexample> counterexample;
    std::string reason;  ///< why it did not run, or what else a reader should know
};

/// What came of a run.
struct DifftestResult {
    std::vector<DifftestPair> pairs;  ///< in the order asked for
    /// The files whose text ran, each with the print of its text without byte order mark and carriage returns.
    std::map<std::string, std::string> texts;
    std::vector<std::string> unread;  ///< files of a build that were refused, with the reasons
};

/// A pair by its ids.
using PairIds = std::pair<std::string, std::string>;

/// Writes, builds and runs both sides of these pairs. This runs code of the repository. Functions that other pairs
/// name and that read what a run does not have are stood in for by one answer on both sides. `all`: every pair of the
/// project; `asked`: those that are run. Throws CannotDo where there is no compiler.
DifftestResult difftest(const Project& project, const std::vector<PairIds>& all, const std::vector<PairIds>& asked,
                        const DifftestSettings& settings, const Disk& disk);

}  // namespace porttool

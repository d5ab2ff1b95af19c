// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "porttool/read/disk.h"
#include "porttool/sync/apply.h"
#include "porttool/sync/bounded_command.h"
#include "porttool/sync/propose.h"

namespace porttool {

/// A command that ran on the proposals.
struct Verification : CommandEnd {
    std::string command;
    bool passed() const { return exit_code == 0; }
};

/// What `10m`, `90s`, `1h` or a plain number of seconds means; none for anything else, and for nothing at all.
std::optional<std::chrono::milliseconds> parse_duration(const std::string& text);

/// Runs a command on a copy of the repository that is written, with these files in it. Throws CannotDo, also where they
/// lie in two repositories.
Verification verify(const std::vector<WrittenFile>& files, const std::string& command, std::chrono::milliseconds limit,
                    Disk& disk);

/// What a person is told of a verification that failed.
std::string failure_of(const Verification& verification);

/// Takes back what a failed verification was run on: what was proposed is left for a person.
void take_back(SyncResult& result, const Verification& verification);

}  // namespace porttool

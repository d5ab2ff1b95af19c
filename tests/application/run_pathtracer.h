// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

// The program itself in a process of its own, and a folder for what it writes.

/// What a run of the program left behind.
struct RunResult {
    int exit_code = -1;  ///< -1: ended by a signal
    std::string out;
    std::string err;
};

/// Runs a program (words[0], sought in PATH) in folder `cwd`; `environment` holds NAME=VALUE strings to add.
RunResult run_program(const std::vector<std::string>& words, const std::filesystem::path& cwd,
                      const std::vector<std::string>& environment = {});

/// Runs pathtracer with these arguments.
RunResult run_pathtracer(const std::vector<std::string>& arguments, const std::filesystem::path& cwd,
                         const std::vector<std::string>& environment = {});

/// The whole content of a file; empty if there is none.
std::string read_file(const std::filesystem::path& file);

/// The names of all files in a folder, sorted.
std::vector<std::string> files_in(const std::filesystem::path& folder);

/// A folder that is gone with this object.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path path;
};

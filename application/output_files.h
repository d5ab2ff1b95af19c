// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render_system/status.h"

// What a run writes must not take the place of what it reads.

namespace application {

/// A file that a run reads, and who reads it as a message has it: "the scene", "--sky".
struct InputFile {
    std::string reader;
    std::filesystem::path file;
};

/// A file that a run is going to write, and the option that names it. An empty name is none.
struct OutputFile {
    std::string option;
    std::filesystem::path file;
};

/// Fails with invalid_argument where one of `outputs` is there and is one of `inputs`, by whatever name: files are the
/// same where device and inode are. The message names option, file and reader.
render_system::Status check_outputs(const std::vector<OutputFile>& outputs, const std::vector<InputFile>& inputs);

}  // namespace application

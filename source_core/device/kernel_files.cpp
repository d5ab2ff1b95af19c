// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/device/kernel_files.h"

#include <filesystem>

#include "render_system/input_file.h"

namespace source_core {

namespace {

// Ours have at most some thousand bytes.
constexpr uint64_t LARGEST_KERNEL = uint64_t{1} << 24;

}  // namespace

Result<std::map<std::string, std::string>> read_kernel_files(const std::string& directory) {
    std::map<std::string, std::string> files;
    for (unsigned i = 0; i < EMBEDDED_KERNEL_COUNT; ++i) {
        files.emplace(EMBEDDED_KERNELS[i].name, EMBEDDED_KERNELS[i].text);
    }
    if (directory.empty()) {
        return files;
    }
    std::error_code error;
    if (!std::filesystem::is_directory(directory, error)) {
        return Status::error(StatusCode::not_found, directory + ": the folder of kernels does not exist");
    }
    for (auto& [name, text] : files) {
        Result<std::string> read =
            render_system::read_input_file(std::filesystem::path(directory) / name, LARGEST_KERNEL);
        if (!read.ok()) {
            read.status.message += "; this kernel is needed in the folder of kernels";
            return read.status;
        }
        text = std::move(*read);
    }
    for (const auto& entry : std::filesystem::directory_iterator(directory, error)) {
        const std::string name = entry.path().filename().string();
        if (!entry.is_regular_file(error) || files.contains(name)) {
            continue;  // a file that somebody added beside ours may be included too
        }
        Result<std::string> read = render_system::read_input_file(entry.path(), LARGEST_KERNEL);
        if (read.ok()) {
            files.emplace(name, std::move(*read));
        }
    }
    return files;
}

}  // namespace source_core

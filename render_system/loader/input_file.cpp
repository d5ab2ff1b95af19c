// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/input_file.h"

#include "render_system/loader/file_bytes.h"
#include "render_system/loader/load_error.h"

namespace render_system {

Result<std::string> read_input_file(const std::filesystem::path& path, uint64_t most_bytes) {
    try {
        const FileBytes file(path);
        const std::span<const std::byte> bytes = file.bytes();
        if (bytes.size() > most_bytes) {
            fail_at("", "has " + std::to_string(bytes.size()) + " bytes; " + std::to_string(most_bytes) +
                            " are the most that is read");
        }
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    } catch (const LoadError& error) {
        return Status::error(error.code, path.string() + ": " + error.message);
    }
}

Status check_input_file(const std::filesystem::path& path) {
    try {
        const FileBytes file(path);
        return Status::success();
    } catch (const LoadError& error) {
        return Status::error(error.code, path.string() + ": " + error.message);
    }
}

}  // namespace render_system

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace render_system {

/// The one way in which files are read here: a file's content, mapped into memory: files of many gigabytes cost address
/// space only until they are read.
class FileBytes {
public:
    FileBytes() = default;
    /// Throws LoadError: not_found if there is no such file, unreadable if it cannot be opened or is no regular file (a
    /// folder, pipe, socket or device), at once and without waiting.
    explicit FileBytes(const std::filesystem::path& path);
    FileBytes(FileBytes&& other) noexcept;
    FileBytes& operator=(FileBytes&& other) noexcept;
    ~FileBytes();

    std::span<const std::byte> bytes() const { return {data_, size_}; }

    /// Lets go of the memory behind bytes already read; they come back from the file if asked for again.
    void release_pages() const;

private:
    const std::byte* data_ = nullptr;
    size_t size_ = 0;
};

}  // namespace render_system

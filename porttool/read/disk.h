// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace porttool {

struct DirectoryEntry {
    std::string name;
    bool is_directory = false;  ///< a real one: symbolic links to folders are not followed
};

/// What reading a file gave: its bytes, or why there are none.
struct FileText {
    std::string bytes;
    std::string error;  ///< empty if the file was read
};

/// The only way to the disk. Paths are absolute or relative to the working directory, `/`-separated.
class Disk {
public:
    virtual ~Disk() = default;
    /// Reads a whole file; one above `limit` bytes is refused unread.
    virtual FileText read(const std::string& path, uint64_t limit) const = 0;
    /// The entries of a folder, sorted by name; nothing if it is none or cannot be read.
    virtual std::optional<std::vector<DirectoryEntry>> list(const std::string& path) const = 0;
    virtual bool is_directory(const std::string& path) const = 0;
    virtual bool exists(const std::string& path) const = 0;
    /// Replaces a file as a whole (never half-written), making its folder; returns why it could not, or "".
    virtual std::string write(const std::string& path, const std::string& bytes) = 0;
    virtual std::string remove(const std::string& path) = 0;
};

class RealDisk final : public Disk {
public:
    FileText read(const std::string& path, uint64_t limit) const override;
    std::optional<std::vector<DirectoryEntry>> list(const std::string& path) const override;
    bool is_directory(const std::string& path) const override;
    bool exists(const std::string& path) const override;
    std::string write(const std::string& path, const std::string& bytes) override;
    std::string remove(const std::string& path) override;
};

/// A disk in memory, for tests. Folders are implied by the files.
class MemoryDisk final : public Disk {
public:
    std::map<std::string, std::string> files;
    std::map<std::string, std::string> errors;  ///< files that cannot be read, and why

    FileText read(const std::string& path, uint64_t limit) const override;
    std::optional<std::vector<DirectoryEntry>> list(const std::string& path) const override;
    bool is_directory(const std::string& path) const override;
    bool exists(const std::string& path) const override;
    std::string write(const std::string& path, const std::string& bytes) override;
    std::string remove(const std::string& path) override;
};

/// `a/b`; an absolute second part stands alone.
std::string join_path(const std::string& folder, const std::string& name);

/// Without `.`, `..` and double slashes as far as the text alone tells.
std::string clean_path(const std::string& path);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "porttool/read/beneath.h"

namespace porttool {

struct DirectoryEntry {
    std::string name;
    bool is_directory = false;  ///< a real one: symbolic links to folders are not followed
    bool is_link = false;
};

/// What reading a file gave: its bytes, or why there are none.
struct FileText {
    std::string bytes;
    std::string error;     ///< empty if the file was read
    bool by_link = false;  ///< there was a link on the way
};

/// The entries of a folder, sorted by name, or why there are none.
struct FolderList {
    std::vector<DirectoryEntry> entries;
    std::string error;
    bool refused = false;  ///< it is there, but leads out of the root, or lies in .git
};

/// Why a file of so many bytes is not read.
std::string too_large(uint64_t size, uint64_t limit);

/// What stands at a path; a link stands for what it leads to.
enum class FileKind : uint8_t { None, File, Folder, Other };

/// Held while a file is replaced by what was made of its present content, so that no other writer's change is lost.
/// Gone with its holder, however that ends.
class WriteGuard {
public:
    virtual ~WriteGuard() = default;
};

/// A guard, or why there is none and what to do.
struct TakenGuard {
    std::unique_ptr<WriteGuard> guard;
    std::string error;
};

/// A file with what it becomes.
struct FileToWrite {
    TreePath place;
    std::string bytes;
};

/// The only way to the disk. What a link leads to is read only where git tracks it or its name is that of a source
/// (read/tracked.h). A path is the user's own, from the command line, absolute or relative to the working
/// directory; a TreePath was written by somebody else, and does not lead out of its root. All are `/`-separated.
class Disk {
public:
    virtual ~Disk() = default;
    /// Reads a whole file; one above `limit` bytes is refused unread.
    virtual FileText read(const std::string& path, uint64_t limit) const = 0;
    virtual FileText read(const TreePath& path, uint64_t limit) const = 0;
    virtual FolderList list(const TreePath& path) const = 0;
    virtual FileKind kind(const TreePath& path) const = 0;
    virtual bool is_directory(const std::string& path) const = 0;
    virtual bool exists(const std::string& path) const = 0;
    /// Replaces a file as a whole (never half-written); returns why it could not, or "". A device, a pipe or an open
    /// file (/dev/stdout) is appended to.
    virtual std::string write(const std::string& path, const std::string& bytes) = 0;
    /// The same beneath a root; makes the file's folder there.
    virtual std::string write(const TreePath& path, const std::string& bytes) = 0;
    /// Replaces all of these files, or, where one of them fails, none. Returns which one and why, or "".
    virtual std::string write_all(const std::vector<FileToWrite>& files);
    /// True for a file that is there and that its owner has closed to writing.
    virtual bool is_read_only(const TreePath& path) const;
    /// Removes a file, or an empty folder; what is not there is no error.
    virtual std::string remove(const TreePath& path) = 0;
    /// Waits until no other process holds the guard of this file.
    virtual TakenGuard guard(const TreePath& path) = 0;
};

class RealDisk final : public Disk {
public:
    FileText read(const std::string& path, uint64_t limit) const override;
    FileText read(const TreePath& path, uint64_t limit) const override;
    FolderList list(const TreePath& path) const override;
    FileKind kind(const TreePath& path) const override;
    bool is_directory(const std::string& path) const override;
    bool exists(const std::string& path) const override;
    std::string write(const std::string& path, const std::string& bytes) override;
    std::string write(const TreePath& path, const std::string& bytes) override;
    std::string write_all(const std::vector<FileToWrite>& files) override;
    bool is_read_only(const TreePath& path) const override;
    std::string remove(const TreePath& path) override;
    TakenGuard guard(const TreePath& path) override;
};

/// A disk in memory, for tests and for what git holds. Folders are implied by the files; there are no links.
class MemoryDisk final : public Disk {
public:
    std::map<std::string, std::string> files;
    std::map<std::string, std::string> errors;  ///< files that cannot be read, and why

    FileText read(const std::string& path, uint64_t limit) const override;
    FileText read(const TreePath& path, uint64_t limit) const override;
    FolderList list(const TreePath& path) const override;
    FileKind kind(const TreePath& path) const override;
    bool is_directory(const std::string& path) const override;
    bool exists(const std::string& path) const override;
    std::string write(const std::string& path, const std::string& bytes) override;
    std::string write(const TreePath& path, const std::string& bytes) override;
    std::string remove(const TreePath& path) override;
    TakenGuard guard(const TreePath& path) override;
};

/// `a/b`; an absolute second part stands alone.
std::string join_path(const std::string& folder, const std::string& name);

/// A path as seen from a root, which it may lie out of: then beneath its own folder. For what the user named.
TreePath place_of_path(const std::string& root, const std::string& path);

/// A path of the user's as seen from the root of the file system, cleaned.
std::string absolute_path(const std::string& path);

/// Without `.`, `..` and double slashes as far as the text alone tells.
std::string clean_path(const std::string& path);

/// `path` as seen from a root; an absolute path elsewhere stays as it is.
std::string path_below(const std::string& root, const std::string& path);

}  // namespace porttool

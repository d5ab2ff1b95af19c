// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/disk.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>

#include "porttool/read/refusals.h"
#include "porttool/read/replace_file.h"
#include "porttool/read/tracked.h"
#include "porttool/read/write_guard.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace fs = std::filesystem;
namespace {

/// Reads an open file, if it is one.
FileText read_open(const Descriptor& file, uint64_t limit) {
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) return {"", cannot_be_read(errno)};
    if (!S_ISREG(status.st_mode)) return {"", "is not a regular file"};
    const auto size = static_cast<uint64_t>(status.st_size);
    if (size > limit) return {"", too_large(size, limit)};
    FileText out;
    out.bytes.resize(size);
    size_t got = 0;
    while (got < size) {
        const ssize_t now = ::read(file.get(), out.bytes.data() + got, size - got);
        if (now < 0 && errno == EINTR) continue;
        if (now < 0) return {"", "cannot be read to its end"};
        if (now == 0) break;  // it became shorter meanwhile
        got += static_cast<size_t>(now);
    }
    out.bytes.resize(got);
    return out;
}

DirectoryEntry entry_in(int folder, const dirent& entry) {
    if (entry.d_type != DT_UNKNOWN) return {entry.d_name, entry.d_type == DT_DIR, entry.d_type == DT_LNK};
    struct stat status {};
    const bool known = ::fstatat(folder, entry.d_name, &status, AT_SYMLINK_NOFOLLOW) == 0;
    return {entry.d_name, known && S_ISDIR(status.st_mode), known && S_ISLNK(status.st_mode)};
}

}  // namespace

std::string too_large(uint64_t size, uint64_t limit) {
    constexpr uint64_t kMebibyte = 1024 * 1024;
    return "is " + std::to_string(size / kMebibyte) + " MiB, more than the " + std::to_string(limit / kMebibyte) +
           " MiB that are read of one file";
}

std::string Disk::write_all(const std::vector<FileToWrite>& files) {
    struct Before {
        const TreePath& place;
        FileText old;
    };
    std::vector<Before> written;
    for (const FileToWrite& file : files) {
        FileText old = read(file.place, std::numeric_limits<uint64_t>::max());
        const std::string failure = write(file.place, file.bytes);
        if (failure.empty()) {
            written.push_back({file.place, std::move(old)});
            continue;
        }
        for (auto one = written.rbegin(); one != written.rend(); ++one)
            (void)(one->old.error.empty() ? write(one->place, one->old.bytes) : remove(one->place));
        return terminal_text(join_path(file.place.root, file.place.path)) + ": " + failure;
    }
    return {};
}

bool Disk::is_read_only(const TreePath&) const { return false; }

FileText RealDisk::read(const std::string& path, uint64_t limit) const {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    return file.valid() ? read_open(file, limit) : FileText{"", cannot_be_read(errno)};
}

FileText RealDisk::read(const TreePath& path, uint64_t limit) const {
    const OpenedBeneath opened = open_beneath(path, O_RDONLY);
    if (!opened.error.empty()) return {"", opened.error};
    if (opened.end.empty()) return read_open(opened.file, limit);
    FileText out = {"", untracked_reason(path.root, opened.end), true};
    if (!out.error.empty()) return {"", "leads to " + terminal_text(opened.end) + ", which " + out.error, true};
    out = read_open(opened.file, limit);
    out.by_link = true;
    return out;
}

FolderList RealDisk::list(const TreePath& path) const {
    OpenedBeneath opened = open_beneath(path, O_RDONLY | O_DIRECTORY);
    if (!opened.error.empty()) return {{}, opened.error, opened.code == EXDEV || opened.code == ELOOP};
    FolderList out;
    DIR* folder = ::fdopendir(opened.file.get());
    if (folder == nullptr) return {{}, cannot_be_read(errno)};
    opened.file.release();  // closedir() closes it
    while (const dirent* entry = ::readdir(folder)) {
        const std::string_view name = entry->d_name;
        if (name != "." && name != "..") out.entries.push_back(entry_in(::dirfd(folder), *entry));
    }
    ::closedir(folder);
    std::sort(out.entries.begin(), out.entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return out;
}

FileKind RealDisk::kind(const TreePath& path) const {
    const OpenedBeneath opened = open_beneath(path, O_PATH);
    if (!opened.error.empty()) return opened.code == EXDEV || opened.code == ELOOP ? FileKind::Other : FileKind::None;
    struct stat status {};
    if (::fstat(opened.file.get(), &status) != 0) return FileKind::None;
    return S_ISREG(status.st_mode) ? FileKind::File : S_ISDIR(status.st_mode) ? FileKind::Folder : FileKind::Other;
}

bool RealDisk::is_directory(const std::string& path) const {
    std::error_code error;
    return fs::is_directory(path, error);
}

bool RealDisk::exists(const std::string& path) const {
    std::error_code error;
    return fs::exists(path, error);
}

std::string RealDisk::write(const std::string& path, const std::string& bytes) { return replace_file(path, bytes); }

std::string RealDisk::write(const TreePath& path, const std::string& bytes) { return replace_file(path, bytes); }

std::string RealDisk::write_all(const std::vector<FileToWrite>& files) { return replace_files(files); }

bool RealDisk::is_read_only(const TreePath& path) const {
    const OpenedBeneath opened = open_beneath(path, O_PATH);
    struct stat status {};
    constexpr mode_t kAnyWrites = S_IWUSR | S_IWGRP | S_IWOTH;
    if (!opened.error.empty() || ::fstat(opened.file.get(), &status) != 0) return false;
    // The system lets root write anywhere; the owner has said what may be written.
    return (status.st_mode & kAnyWrites) == 0 ||
           ::faccessat(opened.file.get(), "", W_OK, AT_EMPTY_PATH | AT_EACCESS) != 0;
}

std::string RealDisk::remove(const TreePath& path) {
    const FolderBeneath at = folder_beneath(path);
    if (!at.error.empty()) return at.error;
    if (::unlinkat(at.folder.get(), at.name.c_str(), 0) == 0 || errno == ENOENT) return {};
    if (errno == EISDIR && ::unlinkat(at.folder.get(), at.name.c_str(), AT_REMOVEDIR) == 0) return {};
    return std::string("cannot be removed: ") + std::strerror(errno);
}

TakenGuard RealDisk::guard(const TreePath& path) { return take_file_guard(path); }

std::string join_path(const std::string& folder, const std::string& name) {
    if (folder.empty() || folder == "." || name.starts_with('/')) return name.empty() ? folder : name;
    if (name.empty() || name == ".") return folder;
    return folder.ends_with('/') ? folder + name : folder + "/" + name;
}

TreePath place_of_path(const std::string& root, const std::string& path) {
    const std::string clean = clean_path(path);
    if (!clean.starts_with('/') && clean != ".." && !clean.starts_with("../")) return {root, path};
    const size_t slash = clean.find_last_of('/');
    return {join_path(root, clean.substr(0, slash + 1)), clean.substr(slash + 1)};
}

std::string absolute_path(const std::string& path) {
    std::error_code error;
    return clean_path(fs::absolute(path, error).generic_string());
}

std::string clean_path(const std::string& path) {
    std::string clean = fs::path(path).lexically_normal().generic_string();
    if (clean.size() > 1 && clean.ends_with('/')) clean.pop_back();
    return clean;
}

std::string path_below(const std::string& root, const std::string& path) {
    std::string clean = clean_path(path);
    const std::string folder = clean_path(root);
    if (clean == folder) return ".";
    return clean.starts_with(folder + "/") ? clean.substr(folder.size() + 1) : clean;
}

}  // namespace porttool

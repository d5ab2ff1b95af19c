// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/disk.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace porttool {
namespace fs = std::filesystem;
namespace {

std::string too_large(uint64_t size, uint64_t limit) {
    constexpr uint64_t kMebibyte = 1024 * 1024;
    return "is " + std::to_string(size / kMebibyte) + " MiB, more than the " + std::to_string(limit / kMebibyte) +
           " MiB that are read of one file";
}

}  // namespace

FileText RealDisk::read(const std::string& path, uint64_t limit) const {
    FileText out;
    std::error_code error;
    const auto status = fs::status(path, error);
    if (error) {
        out.error = "cannot be read: " + error.message();
        return out;
    }
    if (!fs::is_regular_file(status)) {
        out.error = "is not a regular file";
        return out;
    }
    const uint64_t size = fs::file_size(path, error);
    if (!error && size > limit) {
        out.error = too_large(size, limit);
        return out;
    }
    std::FILE* stream = std::fopen(path.c_str(), "rb");
    if (stream == nullptr) {
        out.error = std::string("cannot be read: ") + std::strerror(errno);
        return out;
    }
    out.bytes.resize(size);
    out.bytes.resize(std::fread(out.bytes.data(), 1, size, stream));
    if (std::ferror(stream) != 0) out.error = "cannot be read to its end";
    std::fclose(stream);
    return out;
}

std::optional<std::vector<DirectoryEntry>> RealDisk::list(const std::string& path) const {
    std::error_code error;
    std::vector<DirectoryEntry> entries;
    for (fs::directory_iterator at(path, error), end; !error && at != end; at.increment(error)) {
        std::error_code ignored;
        entries.push_back(
            {at->path().filename().string(), at->symlink_status(ignored).type() == fs::file_type::directory});
    }
    if (error) return std::nullopt;
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return entries;
}

bool RealDisk::is_directory(const std::string& path) const {
    std::error_code error;
    return fs::is_directory(path, error);
}

bool RealDisk::exists(const std::string& path) const {
    std::error_code error;
    return fs::exists(path, error);
}

namespace {

/// Empty, or why the bytes are not in the file.
std::string put_bytes(const std::string& path, const std::string& bytes, std::ios::openmode mode = std::ios::trunc) {
    errno = 0;
    std::ofstream stream(path, std::ios::binary | mode);
    stream << bytes;
    stream.close();
    return stream ? std::string() : std::string("cannot be written: ") + std::strerror(errno);
}

}  // namespace

std::string RealDisk::write(const std::string& path, const std::string& bytes) {
    std::error_code error;
    const fs::path folder = fs::path(path).parent_path();
    if (!folder.empty()) fs::create_directories(folder, error);
    // A link stays a link, and a device, a pipe or an open file (/dev/stdout) is written to, not replaced.
    if (path.starts_with("/dev/") || path.starts_with("/proc/")) return put_bytes(path, bytes, std::ios::app);
    const std::string place = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error).string() : path;
    if (fs::exists(place, error) && !fs::is_regular_file(place, error)) return put_bytes(place, bytes);
    const std::string temporary = place + ".tmp" + std::to_string(::getpid());
    if (const std::string reason = put_bytes(temporary, bytes); !reason.empty()) {
        fs::remove(temporary, error);
        return reason;
    }
    if (const auto before = fs::status(place, error); fs::exists(before))
        fs::permissions(temporary, before.permissions(), error);
    fs::rename(temporary, place, error);
    if (!error) return {};
    const std::string reason = "cannot be written: " + error.message();
    fs::remove(temporary, error);
    return reason;
}

std::string RealDisk::remove(const std::string& path) {
    std::error_code error;
    fs::remove(path, error);
    return error ? "cannot be removed: " + error.message() : std::string();
}

FileText MemoryDisk::read(const std::string& path, uint64_t limit) const {
    if (const auto bad = errors.find(path); bad != errors.end()) return {"", bad->second};
    const auto file = files.find(path);
    if (file == files.end()) return {"", "cannot be read: No such file or directory"};
    if (file->second.size() > limit) return {"", too_large(file->second.size(), limit)};
    return {file->second, ""};
}

std::optional<std::vector<DirectoryEntry>> MemoryDisk::list(const std::string& path) const {
    if (!is_directory(path)) return std::nullopt;
    const std::string prefix = path == "." || path.empty() ? "" : path + "/";
    std::map<std::string, bool> found;
    auto add = [&](const std::string& file) {
        if (!file.starts_with(prefix)) return;
        const std::string rest = file.substr(prefix.size());
        const size_t slash = rest.find('/');
        found[rest.substr(0, slash)] |= slash != std::string::npos;
    };
    for (const auto& [file, bytes] : files) add(file);
    for (const auto& [file, reason] : errors) add(file);
    std::vector<DirectoryEntry> entries;
    for (const auto& [name, folder] : found) entries.push_back({name, folder});
    return entries;
}

bool MemoryDisk::is_directory(const std::string& path) const {
    if (path.empty() || path == ".") return true;
    const auto next = files.lower_bound(path + "/");
    return next != files.end() && next->first.starts_with(path + "/");
}

bool MemoryDisk::exists(const std::string& path) const { return files.contains(path) || is_directory(path); }

std::string MemoryDisk::write(const std::string& path, const std::string& bytes) {
    files[path] = bytes;
    return {};
}

std::string MemoryDisk::remove(const std::string& path) {
    files.erase(path);
    return {};
}

std::string join_path(const std::string& folder, const std::string& name) {
    if (folder.empty() || folder == "." || name.starts_with('/')) return name.empty() ? folder : name;
    if (name.empty() || name == ".") return folder;
    return folder.ends_with('/') ? folder + name : folder + "/" + name;
}

std::string clean_path(const std::string& path) {
    std::string clean = fs::path(path).lexically_normal().generic_string();
    if (clean.size() > 1 && clean.ends_with('/')) clean.pop_back();
    return clean;
}

}  // namespace porttool

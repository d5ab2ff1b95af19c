// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/user_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "porttool/read/disk.h"

namespace porttool {
namespace {

namespace fs = std::filesystem;

/// True for a folder of ours that nobody else can write into.
bool is_own_folder(const std::string& folder) {
    struct stat status {};
    return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
           (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

bool lies_in(const std::string& folder, const std::string& repository) {
    std::error_code error;
    const std::string real = fs::weakly_canonical(folder, error).generic_string();
    if (error) return true;
    const std::string root = fs::weakly_canonical(repository, error).generic_string();
    return error || (real + "/").starts_with(root == "/" ? root : root + "/");
}

bool write_whole(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t took = ::write(descriptor, bytes.data(), bytes.size());
        if (took <= 0) return false;
        bytes.remove_prefix(static_cast<size_t>(took));
    }
    return true;
}

/// Writes pieces one after the other: small ones together, large ones where they stand.
bool write_pieces(int descriptor, const std::vector<std::string_view>& pieces) {
    constexpr size_t kBlock = 1u << 20;
    std::string gathered;
    for (const std::string_view piece : pieces) {
        if (gathered.size() + piece.size() > kBlock) {
            if (!write_whole(descriptor, gathered)) return false;
            gathered.clear();
        }
        if (piece.size() <= kBlock)
            gathered += piece;
        else if (!write_whole(descriptor, piece))
            return false;
    }
    return write_whole(descriptor, gathered);
}

}  // namespace

std::string this_program() {
    struct stat status {};
    if (::stat("/proc/self/exe", &status) != 0) return {};
    return fmt::format("{} {} {} {}.{}", status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec,
                       status.st_mtim.tv_nsec);
}

std::string xdg_cache_home() {
    const char* named = std::getenv("XDG_CACHE_HOME");
    if (named != nullptr && *named == '/') return named;
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home == '/') return join_path(home, ".cache");
    return {};
}

UserCache::UserCache(const std::string& name, const std::string& repository) {
    const std::string home = xdg_cache_home();
    if (home.empty()) return;
    const std::string folder = join_path(join_path(home, "porttool"), name);
    if (!lies_in(folder, repository)) folder_ = folder;
}

std::optional<std::string> UserCache::read(const std::string& file, uint64_t most_bytes) const {
    if (folder_.empty()) return std::nullopt;
    const int descriptor = ::open(join_path(folder_, file).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) return std::nullopt;
    struct stat status {};
    const bool ours = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid() &&
                      (status.st_mode & (S_IWGRP | S_IWOTH)) == 0 &&
                      static_cast<uint64_t>(status.st_size) <= most_bytes && is_ours();
    std::string bytes(ours ? static_cast<size_t>(status.st_size) : 0, '\0');
    size_t taken = 0;
    while (taken < bytes.size()) {
        const ssize_t got = ::read(descriptor, bytes.data() + taken, bytes.size() - taken);
        if (got <= 0) break;
        taken += static_cast<size_t>(got);
    }
    ::close(descriptor);
    if (!ours || taken != bytes.size()) return std::nullopt;
    return bytes;
}

bool UserCache::is_ours() const {
    return is_own_folder(fs::path(folder_).parent_path().string()) && is_own_folder(folder_);
}

bool UserCache::make_folder() const {
    std::error_code error;
    const fs::path all_caches = fs::path(folder_).parent_path();
    fs::create_directories(all_caches.parent_path(), error);
    for (const std::string& folder : {all_caches.string(), folder_})
        if ((::mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST) || !is_own_folder(folder)) return false;
    return true;
}

void UserCache::write(const std::string& file, const std::vector<std::string_view>& pieces, uint64_t most_bytes) const {
    uint64_t size = 0;
    for (const std::string_view piece : pieces) size += piece.size();
    if (folder_.empty() || size > most_bytes || !make_folder()) return;
    std::string unfinished = join_path(folder_, ".new-XXXXXX");
    const int descriptor = ::mkostemp(unfinished.data(), O_CLOEXEC);
    if (descriptor < 0) return;
    const bool written = write_pieces(descriptor, pieces);
    const bool whole = ::close(descriptor) == 0 && written;
    if (!whole || ::rename(unfinished.c_str(), join_path(folder_, file).c_str()) != 0) ::unlink(unfinished.c_str());
    drop_oldest(most_bytes);
}

void UserCache::drop_oldest(uint64_t most_bytes) const {
    struct Entry {
        fs::file_time_type time;
        uint64_t size;
        fs::path path;
    };
    std::vector<Entry> entries;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_, error)) {
        const auto time = entry.last_write_time(error);
        const uint64_t size = error ? 0 : entry.file_size(error);
        if (!error) entries.push_back({time, size, entry.path()});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.time > b.time; });
    uint64_t bytes = 0;
    for (const Entry& entry : entries) {
        bytes += entry.size;
        if (bytes > most_bytes) fs::remove(entry.path, error);
    }
}

}  // namespace porttool

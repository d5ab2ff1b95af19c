// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/write_guard.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "porttool/read/replace_file.h"
#include "porttool/text/fingerprint.h"

namespace porttool {
namespace {

constexpr auto kLongestWait = std::chrono::seconds(30);
constexpr auto kPause = std::chrono::milliseconds(5);
constexpr mode_t kGuardFile = 0666;

class FileGuard final : public WriteGuard {
public:
    FileGuard(Descriptor folder, std::string name, Descriptor file)
        : folder_(std::move(folder)), name_(std::move(name)), file_(std::move(file)) {}
    FileGuard(const FileGuard&) = delete;
    FileGuard& operator=(const FileGuard&) = delete;
    // First the name, then the lock: whoever locks the file after us sees that it has no name, and takes another.
    ~FileGuard() override { (void)::unlinkat(folder_.get(), name_.c_str(), 0); }

private:
    Descriptor folder_;
    std::string name_;
    Descriptor file_;
};

/// True if the file that was locked still has its name.
bool has_name(const Descriptor& folder, const std::string& name, const Descriptor& file) {
    struct stat ours {
    }, named{};
    return ::fstat(file.get(), &ours) == 0 && ::fstatat(folder.get(), name.c_str(), &named, AT_SYMLINK_NOFOLLOW) == 0 &&
           ours.st_ino == named.st_ino && ours.st_dev == named.st_dev;
}

/// What killed writers left beside the file and in portmap.base/: whoever holds the guard is the only one there.
void sweep(const Descriptor& folder, const std::string& name) {
    const auto is_ours = [&](std::string_view file) {
        return file == name || file == "portmap.toml" || is_fingerprint(file);
    };
    sweep_temporaries(folder.get(), is_ours, true);
    const Descriptor base(::openat(folder.get(), "portmap.base", O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (base.valid()) sweep_temporaries(base.get(), is_ours, true);
}

std::string no_guard(const TreePath& path, const std::string& why) {
    return join_path(path.root, path.path) + ".busy " + why +
           "\nporttool makes this file while it writes; make its folder writable, and remove what stands in its place";
}

}  // namespace

TakenGuard take_file_guard(const TreePath& path) {
    FolderBeneath at = folder_beneath({path.root, path.path + ".busy", Links::None});
    if (!at.error.empty()) return {nullptr, no_guard(path, at.error)};
    const auto end = std::chrono::steady_clock::now() + kLongestWait;
    while (true) {
        Descriptor file(::openat(at.folder.get(), at.name.c_str(),
                                 O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, kGuardFile));
        if (!file.valid()) return {nullptr, no_guard(path, std::string("cannot be written: ") + std::strerror(errno))};
        if (::flock(file.get(), LOCK_EX | LOCK_NB) == 0) {
            if (!has_name(at.folder, at.name, file)) continue;
            const std::string name = path.path.substr(path.path.find_last_of('/') + 1);
            sweep(at.folder, name);
            return {std::make_unique<FileGuard>(std::move(at.folder), std::move(at.name), std::move(file)), ""};
        }
        if (errno != EWOULDBLOCK && errno != EINTR)
            return {nullptr, no_guard(path, std::string("cannot be locked: ") + std::strerror(errno))};
        if (std::chrono::steady_clock::now() > end)
            return {nullptr, path.path +
                                 " is being written by another porttool, for half a minute now\nTry again when "
                                 "that has ended: pgrep -a porttool"};
        std::this_thread::sleep_for(kPause);
    }
}

}  // namespace porttool

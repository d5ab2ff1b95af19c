// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/file_watch.h"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace porttool {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr uint32_t kEvents = IN_CLOSE_WRITE | IN_MOVED_FROM | IN_MOVED_TO | IN_CREATE | IN_DELETE | IN_ATTRIB |
                             IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR | IN_EXCL_UNLINK;
/// A file that is written, or removed, is looked at once nothing has happened for so long. Editors that save by
/// renaming need less than a millisecond between the two steps.
constexpr milliseconds kStill{8}, kStillAfterLoss{30};
/// And after so long in any case, as a program may write without an end.
constexpr milliseconds kMostWait{60};
constexpr milliseconds kPollEvery{2000};
constexpr size_t kMostChangedNames = 100;

std::string parent_of(const std::string& path) {
    const size_t slash = path.find_last_of('/');
    return slash == 0 || slash == std::string::npos ? "/" : path.substr(0, slash);
}

std::string name_in(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

int milliseconds_until(Clock::time_point then) {
    return static_cast<int>(std::max<int64_t>(0, std::chrono::ceil<milliseconds>(then - Clock::now()).count()));
}

}  // namespace

FileWatch::FileWatch() : inotify_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)), next_poll_(Clock::now()) {
    polls_ = !inotify_.valid();
}

std::string FileWatch::polling_note() {
    return "note: the system watches no more folders, so files are looked at every two seconds; raise "
           "fs.inotify.max_user_watches and max_user_instances with sysctl\n";
}

void FileWatch::add(const std::string& folder, const std::string* name, std::map<int, Folder>& out) {
    const int number = ::inotify_add_watch(inotify_.get(), folder.c_str(), kEvents);
    if (number < 0) {
        polls_ = polls_ || errno == ENOSPC || errno == ENOMEM || errno == EBADF;
        return;
    }
    Folder& entry = out[number];
    entry.paths.insert(folder);
    if (name == nullptr)
        entry.all = true;
    else
        entry.names.insert(*name);
}

/// A file is watched in its folder, or, where that is not there, in the nearest one above that is. Where it is a link,
/// what it leads to is watched as well.
void FileWatch::add_name(const std::string& path, std::map<int, Folder>& out) {
    std::string at = path;
    std::error_code error;
    while (at != "/" && !std::filesystem::is_directory(parent_of(at), error)) at = parent_of(at);
    const std::string name = name_in(at);
    add(parent_of(at), &name, out);
    if (at != path || !std::filesystem::is_symlink(path, error)) return;
    const std::string there = std::filesystem::weakly_canonical(path, error).string();
    const std::string name_there = name_in(there);
    if (!error && !name_there.empty()) add(parent_of(there), &name_there, out);
}

bool FileWatch::follow(const LookedAt& looked_at) {
    if (!stale_ && looked_at == looked_at_) return false;
    stale_ = false;
    looked_at_ = looked_at;
    std::map<int, Folder> now;
    for (const std::string& folder : looked_at.folders) {
        add(folder, nullptr, now);
        if (folder != "/") add_name(folder, now);
    }
    for (const std::string& name : looked_at.names) add_name(name, now);
    bool fresh = false;
    for (const auto& [number, folder] : now) fresh = fresh || !folders_.contains(number);
    for (const auto& [number, folder] : folders_)
        if (!now.contains(number)) (void)::inotify_rm_watch(inotify_.get(), number);
    folders_ = std::move(now);
    return fresh;
}

/// Reads what has happened; true if any of it counts.
bool FileWatch::take_events() {
    constexpr size_t kRoom = 16384;
    alignas(inotify_event) std::array<char, kRoom> room{};
    bool counts = false;
    for (;;) {
        const ssize_t got = ::read(inotify_.get(), room.data(), room.size());
        if (got <= 0) return counts;
        for (size_t at = 0; at + sizeof(inotify_event) <= static_cast<size_t>(got);) {
            inotify_event event{};
            std::memcpy(&event, room.data() + at, sizeof event);
            const std::string name = event.len == 0 ? "" : room.data() + at + sizeof event;
            at += sizeof event + event.len;
            const auto folder = folders_.find(event.wd);
            const bool overflow = (event.mask & IN_Q_OVERFLOW) != 0;
            const bool itself = (event.mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_UNMOUNT)) != 0;
            if (!overflow && folder == folders_.end()) continue;  // of a watch that was taken back
            constexpr uint32_t kNewHere = IN_ISDIR | IN_CREATE | IN_MOVED_TO;
            if (overflow || itself || (event.mask & (kNewHere | IN_IGNORED)) != 0) stale_ = true;
            if ((event.mask & IN_IGNORED) != 0) {
                folders_.erase(folder);
                continue;
            }
            const bool named = !name.empty() && (overflow || folder->second.all || folder->second.names.contains(name));
            if (!overflow && !itself && !named) continue;
            counts = true;
            if (named && !overflow && changed_names_.size() < kMostChangedNames)
                changed_names_.insert((*folder->second.paths.begin() == "/" ? "" : *folder->second.paths.begin()) +
                                      "/" + name);
            if ((event.mask & (IN_DELETE | IN_MOVED_FROM)) != 0) lost_file_ = true;
            if ((event.mask & (IN_MOVED_TO | IN_CLOSE_WRITE)) != 0) lost_file_ = false;
        }
    }
}

Woken FileWatch::wait(int other, int timeout_ms) {
    const auto end = Clock::now() + milliseconds(std::max(0, timeout_ms));
    for (;;) {
        const auto now = Clock::now();
        if (changed_ ? now >= told_at() : polls_ && now >= next_poll_) {
            changed_ = lost_file_ = false;
            next_poll_ = now + kPollEvery;
            return Woken::Changed;
        }
        if (timeout_ms >= 0 && now >= end) return Woken::Timeout;
        int wait_ms = timeout_ms < 0 ? -1 : milliseconds_until(end);
        if (changed_ || polls_) {
            const int next = milliseconds_until(changed_ ? told_at() : next_poll_);
            wait_ms = wait_ms < 0 ? next : std::min(wait_ms, next);
        }
        std::array<pollfd, 2> ready{pollfd{inotify_.get(), POLLIN, 0}, pollfd{other, POLLIN, 0}};
        const int found = ::poll(ready.data(), ready.size(), wait_ms);
        if (found < 0 && errno == EINTR) return Woken::Other;
        if (found > 0 && ready[0].revents != 0 && take_events()) {
            if (!changed_) latest_ = Clock::now() + kMostWait;
            changed_ = true;
            still_ = Clock::now() + (lost_file_ ? kStillAfterLoss : kStill);
        }
        if (found > 0 && ready[1].revents != 0) return Woken::Other;
    }
}

}  // namespace porttool

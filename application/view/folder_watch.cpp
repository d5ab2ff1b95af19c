// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/folder_watch.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

namespace application {
namespace {

constexpr int kCalmMs = 15;     // an editor that saves by renaming is done by then
constexpr int kFolderMs = 500;  // how often a folder that went away is looked for
constexpr uint32_t kWritten = IN_CLOSE_WRITE | IN_MOVED_TO | IN_DELETE_SELF | IN_MOVE_SELF;
constexpr uint32_t kRemoved = IN_MOVED_FROM | IN_DELETE;

}  // namespace

FolderWatch::FolderWatch(std::string folder, What what)
    : folder_(std::move(folder)),
      events_wanted_(kWritten | (what == What::All ? kRemoved : 0)),
      events_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)),
      end_(::eventfd(0, EFD_CLOEXEC)) {
    (void)listen();
}

FolderWatch::~FolderWatch() {
    if (events_ >= 0) (void)::close(events_);
    if (end_ >= 0) (void)::close(end_);
}

bool FolderWatch::listen() {
    if (watch_ < 0) watch_ = ::inotify_add_watch(events_, folder_.c_str(), events_wanted_ | IN_ONLYDIR);
    return watch_ >= 0;
}

void FolderWatch::end() {
    const uint64_t one = 1;
    (void)!::write(end_, &one, sizeof(one));
}

FolderWatch::Saved FolderWatch::wait() {
    Saved saved;
    std::set<std::string>& names = saved.names;
    while (true) {
        std::array<pollfd, 2> wanted{{{end_, POLLIN, 0}, {events_, POLLIN, 0}}};
        const int patience = !names.empty() ? kCalmMs : watch_ < 0 ? kFolderMs : -1;
        const int ready = ::poll(wanted.data(), wanted.size(), patience);
        if ((wanted[0].revents & POLLIN) != 0) return {};
        if (ready == 0 && !names.empty()) return saved;
        const bool is_first = names.empty();
        while (take_events(names)) continue;
        if (names.empty() && watch_ < 0 && listen()) names.insert("");  // it came back
        if (is_first) saved.at = std::chrono::steady_clock::now();
    }
}

/// False where there were none.
bool FolderWatch::take_events(std::set<std::string>& names) {
    alignas(inotify_event) std::array<char, 8192> room{};
    const ssize_t got = ::read(events_, room.data(), room.size());
    for (ssize_t at = 0; at < got;) {
        inotify_event event{};
        std::memcpy(&event, room.data() + at, sizeof(event));
        const bool is_named = event.len > 0;
        names.insert(is_named ? std::string(room.data() + at + sizeof(event)) : std::string());
        if ((event.mask & IN_MOVE_SELF) != 0) (void)::inotify_rm_watch(events_, watch_);
        if ((event.mask & IN_IGNORED) != 0) watch_ = -1;
        at += static_cast<ssize_t>(sizeof(event) + event.len);
    }
    return got > 0;
}

}  // namespace application

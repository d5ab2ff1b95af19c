// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "porttool/read/beneath.h"
#include "porttool/read/live_disk.h"

namespace porttool {

/// What a wait ended with.
enum class Woken : uint8_t { Changed, Other, Timeout };

/// Tells when files that an answer rests on may have changed (inotify(7)): by folder, so that it sees a file that is
/// replaced by renaming another one over it, one that is not there yet, and one in a new folder. Where the system gives
/// no more watches it says so, and counts every few seconds as a change.
class FileWatch {
public:
    FileWatch();

    /// From here on these are watched and no others. True if folders are watched that were not before: what happened in
    /// them between the look and this call nobody has seen, so look again.
    bool follow(const LookedAt& looked_at);

    /// Waits until what is watched changes and then stays still for a moment, as an editor writes a file in several
    /// steps; or until `other`, a descriptor, can be read; or until the time is over (-1: no end). A call that a signal
    /// interrupts ends as Other. A change that came meanwhile is told by the next call.
    Woken wait(int other, int timeout_ms);

    /// The files that changed since the last call, as far as they are known by name: a few at most.
    std::set<std::string> take_changed() { return std::exchange(changed_names_, {}); }

    /// True where not all can be watched; what to say of that.
    bool is_polling() const { return polls_; }
    static std::string polling_note();

private:
    struct Folder {
        std::set<std::string> paths;  ///< that lead to it; it has a number of its own, the key
        std::set<std::string> names;  ///< in it, which count
        bool all = false;             ///< every name counts
    };
    void add(const std::string& folder, const std::string* name, std::map<int, Folder>& out);
    void add_name(const std::string& path, std::map<int, Folder>& out);
    bool take_events();

    using Time = std::chrono::steady_clock::time_point;
    /// When what has changed is told, unless more happens.
    Time told_at() const { return still_ < latest_ ? still_ : latest_; }

    Descriptor inotify_;
    std::map<int, Folder> folders_;  ///< by number of their watch
    LookedAt looked_at_;             ///< what they were made for
    bool stale_ = true;              ///< a folder or a link came or went, so that they may have to be made anew
    bool polls_ = false;
    bool lost_file_ = false;  ///< one was removed or renamed, and may be about to come back
    bool changed_ = false;    ///< and not told yet
    std::set<std::string> changed_names_;
    Time still_, latest_, next_poll_;
};

}  // namespace porttool

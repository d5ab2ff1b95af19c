// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <set>
#include <string>

namespace application {

/// Tells what is saved in a folder (inotify), however an editor saves: in place, or by a new file of that name. The
/// folder itself may go and come back.
class FolderWatch {
public:
    /// `Written` leaves out what is only removed, or moved away.
    enum class What { All, Written };
    explicit FolderWatch(std::string folder, What what = What::All);
    ~FolderWatch();
    FolderWatch(const FolderWatch&) = delete;
    FolderWatch& operator=(const FolderWatch&) = delete;

    struct Saved {
        std::set<std::string> names;               ///< of files; "" where it is not known which
        std::chrono::steady_clock::time_point at;  ///< when the first of them was noticed
    };
    /// Waits until something was saved and nothing more for a moment. No names once `end` was called.
    Saved wait();
    /// May be called from another thread.
    void end();

private:
    bool listen();
    bool take_events(std::set<std::string>& names);

    const std::string folder_;
    const uint32_t events_wanted_;
    int events_ = -1, end_ = -1, watch_ = -1;
};

}  // namespace application

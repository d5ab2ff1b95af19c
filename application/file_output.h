// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "render_system/status.h"

// Files that are there whole or not at all: written beside their place under another name, then renamed. A signal that
// ends the program meanwhile takes the unfinished file away.

namespace application {

/// Whether `file` could be written now: its folder exists and takes new files, or it is a pipe that somebody reads from
/// (which then stays open until it is written). To be asked before hours of rendering; never waits. Fails with
/// invalid_argument; the message names the file, the reason and the remedy.
render_system::Status check_writable(const std::filesystem::path& file);

/// Writes `bytes` to `file`, in place of what is there. What is there and is no regular file (a pipe, a device) is
/// written to directly. Fails as check_writable does, or if the disk is full.
render_system::Status write_file(const std::filesystem::path& file, std::string_view bytes);

/// As write_file, and what was written is on the disk itself before it takes the place of what was there: a machine
/// that loses its power has one or the other.
render_system::Status write_file_durably(const std::filesystem::path& file, std::string_view bytes);

/// A descriptor of `file`, emptied, for what is to be read while it grows: a log. Fails as check_writable does.
render_system::Result<int> open_emptied(const std::filesystem::path& file);

/// A folder for what a run writes, made before its work with all above it that is not there. What was made goes with
/// this object, or on a signal, where nothing lies in it. One at a time.
class FolderToFill {
public:
    /// An empty name is no folder.
    explicit FolderToFill(const std::filesystem::path& folder);
    ~FolderToFill();
    FolderToFill(const FolderToFill&) = delete;
    FolderToFill& operator=(const FolderToFill&) = delete;

    /// Fails with invalid_argument where it cannot be made or takes no files.
    const render_system::Status& status() const { return status_; }

private:
    render_system::Status status_;
};

/// Lets SIGINT, SIGTERM and SIGHUP remove an unfinished file before they end the program. Those that the caller has
/// ignored, as nohup does, stay ignored.
void remove_unfinished_file_on_signals();

/// What these do then. For handlers of signals alone: the program ends when the handler returns.
extern "C" void remove_unfinished_file_and_end(int signal_number);

}  // namespace application

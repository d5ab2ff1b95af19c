// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "render_system/status.h"

namespace application {

/// The log of a window: JSON lines `{"t_ms","event","detail"}`, each written at once. Without a file it says nothing.
class ViewLog {
public:
    /// Empties the file. Fails with invalid_argument where it cannot be written.
    render_system::Status open(const std::string& file);

    /// `event`: input, pixels, switch, reload, finding, patch or error.
    void say(const char* event, const nlohmann::ordered_json& detail);

    /// Fails with invalid_argument once something could not be written.
    const render_system::Status& status() const { return status_; }

    /// Since the log was made.
    double now_ms() const { return ms_of(std::chrono::steady_clock::now()); }
    double ms_of(std::chrono::steady_clock::time_point moment) const;

private:
    struct Close {
        void operator()(std::FILE* file) const { (void)std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file_;
    std::string name_;
    render_system::Status status_ = render_system::Status::success();
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace application

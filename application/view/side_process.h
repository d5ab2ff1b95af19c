// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace application {

/// A program that runs beside the window, and what it says; read without ever waiting for it.
class SideProcess {
public:
    SideProcess() = default;
    /// Starts it; the first argument is its path.
    explicit SideProcess(const std::vector<std::string>& arguments);
    SideProcess(SideProcess&& other) noexcept { *this = std::move(other); }
    SideProcess& operator=(SideProcess&& other) noexcept;
    ~SideProcess() { end(); }

    bool is_started() const { return process_ > 0; }
    /// Takes what came since the last call, and its end.
    void update();
    /// What it said so far and nobody took away.
    std::string& out() { return texts_[0]; }
    const std::string& errors() const { return texts_[1]; }
    /// Once it has ended and all was read; 128 and more: by a signal.
    std::optional<int> exit_code() const { return exit_code_; }

private:
    void end();
    pid_t process_ = -1;
    std::array<int, 2> pipes_{-1, -1};  // its stdout and stderr
    std::array<std::string, 2> texts_;
    std::optional<int> exit_code_;
};

}  // namespace application

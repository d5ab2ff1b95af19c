// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "application/view/view_log.h"

namespace application {

/// A program that runs beside the window, and what it says on stdout; read without ever waiting for it.
class SideProcess {
public:
    SideProcess() = default;
    /// Starts it; the first argument is its path. `error` says why it could not.
    explicit SideProcess(const std::vector<std::string>& arguments);
    SideProcess(SideProcess&& other) noexcept { *this = std::move(other); }
    SideProcess& operator=(SideProcess&& other) noexcept;
    ~SideProcess() { end(); }

    bool is_started() const { return process_ > 0; }
    /// What came since the last call; the process has ended where that is so.
    std::string read();
    /// The exit code, once it has ended and all was read.
    std::optional<int> exit_code() const { return exit_code_; }

private:
    void end();
    pid_t process_ = -1;
    int pipe_ = -1;
    std::optional<int> exit_code_;
};

/// A finding as `porttool watch --format json` tells it.
struct DriftFinding {
    std::string rule, level, message, source, target, fingerprint;
};

/// The findings of porttool for the files under watch, beside the picture. All is done by `porttool` as a process of
/// its own: nothing is judged here.
class DriftPanel {
public:
    /// Watches the project of that folder. Without a porttool, beside this program or in PATH, the panel says so.
    DriftPanel(std::string folder, ViewLog& log);

    /// Reads what the processes said.
    void update();

    const std::map<std::string, DriftFinding>& findings() const { return findings_; }
    /// How the project stands, or why that is not known: a line.
    const std::string& standing() const { return standing_; }

    /// Asks `porttool sync` for the port of a finding's edit; `proposal` shows it when it is there.
    void propose(const DriftFinding& finding);
    /// Has `porttool sync --apply` write it.
    void apply();
    void accept(const DriftFinding& finding);
    const std::string& proposal() const { return proposal_; }
    /// Whether there is a patch that can be applied.
    bool can_apply() const { return can_apply_; }

private:
    void take_line(const std::string& line);
    void take_proposal(const std::string& text);

    std::string program_, folder_;
    ViewLog& log_;
    SideProcess watch_, sync_, verdict_;
    std::string watched_text_, proposed_text_, verdict_text_;
    std::map<std::string, DriftFinding> findings_;
    std::string standing_, proposal_, proposed_;
    bool can_apply_ = false;
};

}  // namespace application

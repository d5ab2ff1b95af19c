// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "application/view/side_process.h"
#include "application/view/view_log.h"

namespace application {

/// One side of a finding; empty where the finding has none.
struct DriftSide {
    std::string id, file;
    int line = 0;
    std::string text;  ///< of the unit, as it was in the file when the finding was told
};

/// A finding as `porttool watch --format json` tells it.
struct DriftFinding {
    std::string rule, level, message, fingerprint;
    DriftSide source, target;
    std::vector<std::string> details;  ///< the edit: lines that begin with - or +
};

/// The findings of porttool for the files under watch, beside the picture, and what a person can do about one. All of
/// it is done by `porttool` as a process of its own: nothing is judged here.
class DriftPanel {
public:
    /// Watches the project of that folder with `porttool`, by default the one beside this program, else that in PATH;
    /// where there is none the panel says so.
    DriftPanel(std::string folder, ViewLog& log);
    DriftPanel(std::string porttool, std::string folder, ViewLog& log);

    /// Reads what the processes said; true where something became different.
    bool update();

    /// Sorted by place.
    const std::vector<DriftFinding>& findings() const { return findings_; }
    /// How the project stands, or why that is not known: a line.
    const std::string& standing() const { return standing_; }

    /// The finding that the person is at; null where there is none.
    const DriftFinding* selected() const;
    void select(const std::string& fingerprint);
    void select_next();

    /// What a person asked porttool about the selected finding, and what came of it.
    enum class Step {
        None,
        Asked,    ///< porttool looks for the port
        Shown,    ///< `patch` can be applied
        Refused,  ///< there is no patch that could be: `said` has why
        Writing,  ///< porttool applies, accepts or defers
        Written,
        Failed,  ///< it did not: `said` has why
    };
    Step step() const { return step_; }
    const std::string& patch() const { return patch_; }
    const std::string& said() const { return said_; }
    /// Whether applying failed for want of `force` alone.
    bool wants_force() const { return wants_force_; }

    /// Asks `porttool sync` for the port of the selected finding's edit.
    void propose();
    /// Has `porttool sync --apply` write the patch that is shown, and `porttool accept` record the pair as in step.
    /// Does nothing where none is shown, or the texts have changed since; `force` writes files with uncommitted changes
    /// too.
    void apply(bool force = false);
    /// Neither does anything where what porttool needs is empty.
    void accept(const std::string& reason);
    void defer(const std::string& reason, const std::string& owner, const std::string& until);

private:
    void take_line(const std::string& line);
    void take_finding(DriftFinding finding);
    void drop(const std::string& fingerprint);
    void take_proposal();
    void take_verdict();
    void ask(Step step, std::vector<std::string> arguments);

    std::string program_, folder_, root_;
    ViewLog& log_;
    SideProcess watch_, asked_;
    std::vector<DriftFinding> findings_;
    std::string standing_, selected_, proposed_;  // the last two are fingerprints
    Step step_ = Step::None;
    std::string patch_, said_;
    std::string pair_;  // SOURCE=TARGET of what is proposed
    std::vector<std::string> then_ask_;
    bool wants_force_ = false, applies_ = false;
};

}  // namespace application

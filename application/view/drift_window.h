// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "application/view/drift_panel.h"

namespace application {

/// Where a panel stands in the window, in pixels.
struct PanelPlace {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;

    /// Of Dear ImGui's window that is being drawn.
    static PanelPlace of_window();
    bool holds(double at_x, double at_y) const {
        return at_x >= x && at_y >= y && at_x < x + width && at_y < y + height;
    }
};

/// The drift panel as Dear ImGui shows it: the findings, of the one that is chosen both texts, the patch, and what a
/// person fills in.
class DriftWindow {
public:
    explicit DriftWindow(DriftPanel& panel);

    /// To be called between NewFrame and Render. It opens itself with the first finding.
    void draw();

    const PanelPlace& place() const { return place_; }

    // Keys.
    void next_finding();
    void propose();
    void apply();

private:
    void draw_list();
    void draw_texts(const DriftFinding& finding) const;
    void draw_port();
    void draw_verdicts();

    DriftPanel& panel_;
    PanelPlace place_;
    bool opens_ = false, was_open_ = false, had_findings_ = false;
    std::array<char, 256> reason_{}, owner_{}, until_{};
};

}  // namespace application

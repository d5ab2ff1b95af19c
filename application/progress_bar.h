// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "application/console.h"

namespace application {

/// How far a rendering has come.
struct Progress {
    std::string label;
    uint64_t samples_done = 0;
    uint64_t samples_wanted = 0;
    double rays_per_second = 0.0;
    double seconds_left = 0.0;
};

/// One line such as `target [#####-----]  50%  8/16 samples  4.2 Mrays/s  0:12 left`.
std::string progress_line(const Progress& progress);

/// The bar on stderr, gone with this object; says nothing where the console shows no progress.
class ProgressBar {
public:
    ProgressBar(Console& console, std::string label);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// `rendering_seconds` is the time that `samples_done` and `rays` took; what is left is extrapolated from it.
    void show(uint64_t samples_done, uint64_t samples_wanted, uint64_t rays, double rendering_seconds);

private:
    Console& console_;
    std::string label_;
};

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/progress_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace application {
namespace {

constexpr int BAR_WIDTH = 24;

std::string clock_time(double seconds) {
    const auto whole = static_cast<uint64_t>(std::min(std::ceil(seconds), 1e9));
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

std::string progress_line(const Progress& progress) {
    const double share = progress.samples_wanted == 0 ? 1.0
                                                      : static_cast<double>(progress.samples_done) /
                                                            static_cast<double>(progress.samples_wanted);
    const int filled = static_cast<int>(share * BAR_WIDTH);
    const std::string bar =
        std::string(static_cast<size_t>(filled), '#') + std::string(static_cast<size_t>(BAR_WIDTH - filled), '-');
    return fmt::format("{} [{}] {:3.0f}%  {}/{} samples  {:.1f} Mrays/s  {} left", progress.label, bar,
                       std::floor(share * 100.0), progress.samples_done, progress.samples_wanted,
                       progress.rays_per_second * 1e-6, clock_time(progress.seconds_left));
}

ProgressBar::ProgressBar(Console& console, std::string label) : console_(console), label_(std::move(label)) {}

ProgressBar::~ProgressBar() { console_.progress(""); }

void ProgressBar::show(uint64_t samples_done, uint64_t samples_wanted, uint64_t rays, double rendering_seconds) {
    if (!console_.shows_progress()) return;
    Progress progress{label_, samples_done, samples_wanted, 0.0, 0.0};
    if (rendering_seconds > 0.0 && samples_done > 0) {
        progress.rays_per_second = static_cast<double>(rays) / rendering_seconds;
        progress.seconds_left =
            rendering_seconds * static_cast<double>(samples_wanted - samples_done) / static_cast<double>(samples_done);
    }
    console_.progress(progress_line(progress));
}

}  // namespace application

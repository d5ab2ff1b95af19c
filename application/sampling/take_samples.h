// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "application/console.h"
#include "application/core_session.h"
#include "application/options.h"
#include "application/sampling/interrupt.h"
#include "application/sampling/sample_sums.h"

namespace application {

/// Which samples are taken: those of --samples, else the first --spp. Where only --time-limit or --noise ends the run,
/// as many as there can be.
SampleRange wanted_samples(const Options& options);

/// Whether squares of samples are summed as well: to tell their noise.
bool keeps_squares(const Options& options);

/// Between two looks at the clock and at signals: a fifth of the time that samples have taken so far, within these.
struct Portions {
    double least_seconds = 0.25;
    double most_seconds = 0.25;
};

/// Those of a team, all of whose sums go to its leader and back for each: less often once it is known to be a long run.
constexpr Portions kTeamPortions = {2.0, 10.0};

/// When a run of samples stops, and what happens on the way.
struct SamplingPlan {
    SampleRange wanted;
    std::chrono::steady_clock::time_point start;  ///< of the time limit
    std::optional<double> time_limit;             ///< seconds
    std::optional<double> noise;
    std::optional<double> checkpoint;  ///< seconds between two
    std::function<void()> write_checkpoint = {};
    /// What takes so many samples of every pixel.
    std::function<render_system::Status(uint32_t count)> render = {};
    /// What brings the sums here, where they may lie elsewhere.
    std::function<void()> collect = [] {};
    Portions portions = {};
    const KeptInterrupt* interrupt = nullptr;
    std::string label = {};  ///< of the progress bar; the core's name where it is empty
};

/// Why it stopped.
enum class SamplingEnd { all_taken, time_limit, noise, interrupted };

/// Takes samples until the plan says stop, with a progress bar. The session's sums hold the result. Where the run stops
/// for its noise is a matter of the samples alone, not of time.
render_system::Result<SamplingEnd> take_samples(CoreSession& session, SampleSums& sums, const SamplingPlan& plan,
                                                Console& console);

}  // namespace application

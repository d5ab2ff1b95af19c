// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "application/options.h"
#include "render_system/core_data.h"
#include "render_system/embree_probe.h"

// What a core counted and timed, as the JSON object of `bench` and `--stats`, and as text.

namespace application {

using Json = nlohmann::ordered_json;

/// One frame of one sample per pixel; times are wall time, or thread time divided by threads.
struct FrameFigures {
    double primary_rays = 0.0;
    double extension_rays = 0.0;
    double shadow_rays = 0.0;
    double generate_ms = 0.0;
    double extend_ms = 0.0;
    double shade_ms = 0.0;
    double connect_ms = 0.0;
    double finalize_ms = 0.0;
    double total_ms = 0.0;
    double trace_limit_rays = 0.0;  ///< by Embree alone; 0: not measured
    double trace_limit_ms = 0.0;
};

/// The mean frame of everything since the last Restart.
FrameFigures mean_frame(const render_system::CoreStats& stats);

/// The frame between two readings of the same core, of which the second was taken `frames` samples later.
FrameFigures frame_between(const render_system::CoreStats& before, const render_system::CoreStats& after);

/// Means of the counts, medians of the times.
FrameFigures typical_frame(const std::vector<FrameFigures>& frames);

/// The bench object of the contract. `frames` is how many frames stand behind the figures; zeros in `embree` become
/// null.
Json bench_json(const Options& options, const render_system::CoreStats& stats,
                const render_system::EmbreeFigures& embree, const FrameFigures& frame, uint64_t frames);

/// The bench object with what `--stats` adds.
Json stats_json(Json bench, const Options& options, uint32_t spp, const std::string& core_reason);

/// The bench object for a person.
std::string bench_text(const Json& bench);

/// The most memory that this process has held at once, in bytes.
uint64_t peak_rss_bytes();

}  // namespace application

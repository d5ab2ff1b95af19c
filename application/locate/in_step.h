// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "application/core_session.h"
#include "application/locate/path_comparison.h"
#include "application/stats_report.h"

namespace application {

/// What one core made: a picture for each sample count.
struct CoreResult {
    std::map<uint32_t, Picture> pictures;
    Json stats;
};

/// The counters and times of a core that has rendered all samples.
Json core_stats(CoreSession& session, const Options& options, const std::string& core_reason);

/// What two cores made, and where their paths parted.
struct InStep {
    std::array<CoreResult, 2> cores;
    PathDifferences differences;
    std::vector<render_system::KernelText> texts;  ///< of both
};

/// Renders sample after sample on both cores, every path held side by side after every kernel. The pictures are those
/// that the cores make alone. Needs the memory of both cores at once, and about 800 bytes a pixel. Fails as
/// CoreSession::start, or with out_of_memory.
render_system::Result<InStep> render_in_step(const std::array<const char*, 2>& cores, const Options& options,
                                             const SceneSetup& setup, Console& console);

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace render_system {

/// Embree's own part in what a core did and holds.
struct EmbreeFigures {
    double build_ms = 0.0;      ///< of CoreStats::build_ms
    uint64_t memory_bytes = 0;  ///< of CoreStats::memory_bytes: its tree with the vertices and indices it reads
    double limit_ms = 0.0;      ///< of the last Render, if measured: wall time of the same rays by Embree alone
    uint64_t limit_rays = 0;
};

/// What a core can be asked beside CoreAPI that traces with Embree: a dynamic_cast of the core tells.
class EmbreeProbe {
public:
    virtual ~EmbreeProbe() = default;
    virtual EmbreeFigures embree_figures() const = 0;
    /// From the next Render on, whether Embree alone traces the same rays once more afterwards. Not in exact mode.
    virtual void measure_embree_limit(bool on) = 0;
};

}  // namespace render_system

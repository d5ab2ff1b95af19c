// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "render_system/core_api.h"

namespace target_core {

/// The CPU port: the source core's kernels in C++, Embree for the rays, TBB for the tiles. The core opens Embree in
/// Init.
std::unique_ptr<render_system::CoreAPI> create_core();

/// Embree's own part in what the core did and holds.
struct EmbreeFigures {
    double build_ms = 0.0;      ///< of CoreStats::build_ms
    uint64_t memory_bytes = 0;  ///< of CoreStats::memory_bytes: its tree with the vertices and indices it reads
    double limit_ms = 0.0;      ///< of the last Render, if measured: wall time of the same rays by Embree alone
    uint64_t limit_rays = 0;
};

/// What this core alone can be asked.
class EmbreeProbe {
public:
    virtual ~EmbreeProbe() = default;
    virtual EmbreeFigures embree_figures() const = 0;
    /// From the next Render on, whether Embree alone traces the same rays once more afterwards. Not in exact mode.
    virtual void measure_embree_limit(bool on) = 0;
};

/// The probe of a core that create_core made; null for any other core.
inline EmbreeProbe* embree_probe(render_system::CoreAPI& core) { return dynamic_cast<EmbreeProbe*>(&core); }

}  // namespace target_core

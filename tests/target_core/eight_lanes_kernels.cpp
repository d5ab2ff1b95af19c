// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/target_core/eight_lanes_kernels.h"

// The kernel text over eight lanes, in a namespace of its own.
#define TARGET_CORE_LANES "tests/target_core/eight_lanes.h"
#define TARGET_CORE_TRACE "tests/target_core/eight_lanes_trace.h"
#define kernels kernels_of_eight_lanes
#include "target_core/kernels/finalize.h"
#include "target_core/kernels/generate.h"
#include "target_core/kernels/shade.h"

namespace eight_lanes {

using namespace target_core;

namespace {

template <class Kernel>
void over_jobs(const Settings& settings, const Pass& pass, uint count, Kernel&& kernel) {
    kernels::settings = settings;
    kernels::pass = pass;
    for (uint job = 0; job < count; job += kernels::LANES) {
        kernels::Uint jobs(job);
        for (uint lane = 0; lane < kernels::LANES; ++lane) {
            jobs.v[lane] += lane;
        }
        kernel(jobs);
    }
}

}  // namespace

void generate(const Settings& settings, const Pass& pass) {
    over_jobs(settings, pass, pass.path_count, kernels::generate_path);
}

void shade(const Settings& settings, const Pass& pass) {
    over_jobs(settings, pass, bound.tile->current.count, kernels::shade_path);
}

void finalize(const Settings& settings, const Pass& pass) {
    over_jobs(settings, pass, pass.path_count, kernels::finalize_pixel);
}

}  // namespace eight_lanes

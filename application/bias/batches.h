// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "application/core_session.h"
#include "metrics/image/tile_means.h"

namespace application {

/// How the samples of a pixel are cut into batches, each of which is rendered with a seed of its own.
struct BatchPlan {
    uint32_t batches = 1;
    uint32_t samples = 1;  ///< per pixel and batch

    uint32_t total() const { return batches * samples; }
};

/// 32 batches, or 16 where there are fewer than 64 samples; what does not divide is left out. Below 16 samples each is
/// a batch.
BatchPlan plan_batches(uint32_t samples);

/// The fewest samples, of those that a plan uses to the last, that are at least `samples` and enough for a verdict.
uint64_t samples_of_plan(double samples);

/// The seed of one batch: core 0 and 1 never share one by design, and seeds of other comparisons are others.
uint32_t batch_seed(uint32_t seed, uint32_t core, uint32_t batch);

/// What a core made, batch by batch.
struct BatchedRender {
    metrics::TileMeans means;
    Picture picture;  ///< the mean of all
};

/// Renders all batches with a session whose core has started on `target`, its picture.
render_system::Result<BatchedRender> render_batches(CoreSession& session, const Picture& target, const BatchPlan& plan,
                                                    uint32_t seed, uint32_t core, Console& console);

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "application/core_session.h"
#include "application/picture.h"
#include "application/sampling/sample_sums.h"

namespace application {

/// A still picture under `--filter temporal`: passes of one sample each, filtered one after another with what the
/// passes before have left. The sums go on holding plain samples.
class TemporalPasses {
public:
    /// The session's core must have taken the first sample, number `first_sample`, into `sums`.
    TemporalPasses(CoreSession& session, SampleSums& sums, uint32_t first_sample);

    /// Takes so many samples more and filters each. Fails as the core does.
    render_system::Status take(uint32_t count);

    /// What the last pass has left; filters the first one where there was no other.
    render_system::Result<Picture> picture();

private:
    render_system::Status filter_last();

    CoreSession& session_;
    SampleSums& sums_;
    const uint32_t first_sample_;
    uint32_t filtered_ = 0;                        // passes
    std::vector<render_system::PixelSum> summed_;  // of these
    Picture picture_;
};

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "application/core_session.h"
#include "application/picture.h"
#include "application/sampling/sample_sums.h"

namespace application {

/// What filtered passes have left so far.
struct KeptPasses {
    render_system::CoreHistory history;
    std::vector<glm::vec4> picture;  ///< of the last one
};

/// A still picture under `--filter temporal`: passes of one sample each, filtered one after another with what the
/// passes before have left. The sums go on holding plain samples.
class TemporalPasses {
public:
    /// `take_sample` adds the next sample to `sums`, of which number `first_sample` is the first; it may be there.
    TemporalPasses(CoreSession& session, SampleSums& sums, uint32_t first_sample,
                   std::function<render_system::Status()> take_sample);

    /// Takes so many samples more and filters each. Fails as the core does.
    render_system::Status take(uint32_t count);

    /// What the last pass has left; filters the first one where there was no other.
    render_system::Result<Picture> picture();

    /// For another run that goes on after these passes.
    render_system::Result<KeptPasses> kept();

    /// Goes on after passes that were kept; the sums are those of then.
    render_system::Status go_on_after(KeptPasses passes);

private:
    render_system::Status filter_last();

    CoreSession& session_;
    SampleSums& sums_;
    const uint32_t first_sample_;
    std::function<render_system::Status()> take_sample_;
    uint32_t filtered_ = 0;                        // passes
    std::vector<render_system::PixelSum> summed_;  // of these
    Picture picture_;
};

}  // namespace application

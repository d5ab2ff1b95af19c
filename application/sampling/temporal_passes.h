// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
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
    /// Filters ask `is_called_off`, from several threads.
    TemporalPasses(CoreSession& session, SampleSums& sums, uint32_t first_sample,
                   std::function<render_system::Status()> take_sample, std::function<bool()> is_called_off);

    /// Takes so many samples more and filters each. Fails as the core does. A pass that is called off is its last one:
    /// its sample is off the sums again, which are those of the passes that are whole, but for the very first.
    render_system::Status take(uint32_t count);

    /// What the last pass has left; filters the first one where there was no other, which may be called off.
    render_system::Result<Picture> picture();

    /// How many are whole.
    uint32_t count() const { return filtered_; }

    /// For another run that goes on after these passes.
    render_system::Result<KeptPasses> kept();

    /// Goes on after passes that were kept; the sums are those of then.
    render_system::Status go_on_after(KeptPasses passes);

private:
    render_system::Status filter_last();
    void note_sums();
    void drop_last();

    CoreSession& session_;
    SampleSums& sums_;
    const uint32_t first_sample_;
    std::function<render_system::Status()> take_sample_;
    std::function<bool()> is_called_off_;
    std::atomic<uint32_t> filtered_ = 0;           // passes
    std::vector<render_system::PixelSum> summed_;  // of these
    std::vector<double> summed_squares_;
    Picture picture_;
};

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/temporal_passes.h"

namespace application {

using render_system::Convergence;
using render_system::FilterHistory;
using render_system::Result;
using render_system::Status;

TemporalPasses::TemporalPasses(CoreSession& session, SampleSums& sums, uint32_t first_sample)
    : session_(session),
      sums_(sums),
      first_sample_(first_sample),
      summed_(sums.pixels.size()),
      picture_(sums.width, sums.height) {}

Status TemporalPasses::take(uint32_t count) {
    Status status = filtered_ == 0 ? filter_last() : Status::success();
    for (uint32_t i = 0; i < count && status.ok(); ++i) {
        status = session_.render(Convergence::Converge, 1);
        if (status.ok()) status = filter_last();
    }
    return status;
}

Result<Picture> TemporalPasses::picture() {
    if (filtered_ == 0)
        if (Status status = filter_last(); !status.ok()) return status;
    return picture_;
}

/// Sums are exact: what the last pass added to them is its sample.
Status TemporalPasses::filter_last() {
    for (size_t i = 0; i < summed_.size(); ++i)
        picture_.pixels[i] = glm::vec4(mean_of(difference(sums_.pixels[i], summed_[i]), 1), 1.0f);
    summed_ = sums_.pixels;
    const FilterHistory history = filtered_ == 0 ? FilterHistory::begin : FilterHistory::go_on;
    const uint32_t sample = first_sample_ + filtered_++;
    return session_.filter(picture_, {}, {sample, sample + 1}, history);
}

}  // namespace application

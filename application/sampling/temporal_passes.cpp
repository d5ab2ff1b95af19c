// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/temporal_passes.h"

#include <utility>

namespace application {

using render_system::FilterHistory;
using render_system::Result;
using render_system::Status;

TemporalPasses::TemporalPasses(CoreSession& session, SampleSums& sums, uint32_t first_sample,
                               std::function<Status()> take_sample)
    : session_(session),
      sums_(sums),
      first_sample_(first_sample),
      take_sample_(std::move(take_sample)),
      summed_(sums.pixels.size()),
      picture_(sums.width, sums.height) {}

Status TemporalPasses::take(uint32_t count) {
    Status status = filtered_ < sums_.samples ? filter_last() : Status::success();
    for (uint32_t i = 0; i < count && status.ok(); ++i) {
        status = take_sample_();
        if (status.ok()) status = filter_last();
    }
    return status;
}

Result<Picture> TemporalPasses::picture() {
    if (filtered_ < sums_.samples)
        if (Status status = filter_last(); !status.ok()) return status;
    return picture_;
}

Result<KeptPasses> TemporalPasses::kept() {
    auto history = session_.history();
    if (!history.ok()) return history.status;
    return KeptPasses{std::move(*history), picture_.pixels};
}

Status TemporalPasses::go_on_after(KeptPasses passes) {
    filtered_ = passes.history.frames;
    if (filtered_ > 0) summed_ = sums_.pixels;
    picture_.pixels = std::move(passes.picture);
    return session_.go_on_with(passes.history);
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

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/temporal_passes.h"

#include <algorithm>
#include <utility>

namespace application {

using render_system::FilterHistory;
using render_system::Result;
using render_system::Status;
using render_system::StatusCode;

TemporalPasses::TemporalPasses(CoreSession& session, SampleSums& sums, uint32_t first_sample,
                               std::function<Status()> take_sample, std::function<bool()> is_called_off)
    : session_(session),
      sums_(sums),
      first_sample_(first_sample),
      take_sample_(std::move(take_sample)),
      is_called_off_(std::move(is_called_off)),
      summed_(sums.pixels.size()),
      summed_squares_(sums.squares.size()),
      picture_(sums.width, sums.height) {}

Status TemporalPasses::take(uint32_t count) {
    Status status = filtered_ < sums_.samples ? filter_last() : Status::success();
    for (uint32_t i = 0; i < count && status.ok(); ++i) {
        status = take_sample_();
        if (status.ok()) status = filter_last();
    }
    if (status.code != StatusCode::called_off) return status;
    if (filtered_ > 0) drop_last();
    return Status::success();
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
    if (filtered_ > 0) note_sums();
    picture_.pixels = std::move(passes.picture);
    return session_.go_on_with(passes.history);
}

/// Sums are exact: what the last pass added to them is its sample.
Status TemporalPasses::filter_last() {
    Picture next(sums_.width, sums_.height);
    for (size_t i = 0; i < summed_.size(); ++i)
        next.pixels[i] = glm::vec4(mean_of(difference(sums_.pixels[i], summed_[i]), 1), 1.0f);
    const FilterHistory history = filtered_ == 0 ? FilterHistory::begin : FilterHistory::go_on;
    const uint32_t sample = first_sample_ + filtered_;
    const Status status = session_.filter(next, {}, {sample, sample + 1}, is_called_off_, history);
    if (!status.ok()) return status;
    picture_ = std::move(next);
    note_sums();
    ++filtered_;
    return status;
}

void TemporalPasses::note_sums() {
    summed_ = sums_.pixels;
    summed_squares_ = sums_.squares;
}

/// In place: the core knows where the sums are.
void TemporalPasses::drop_last() {
    sums_.samples = filtered_;
    std::copy(summed_.begin(), summed_.end(), sums_.pixels.begin());
    std::copy(summed_squares_.begin(), summed_squares_.end(), sums_.squares.begin());
}

}  // namespace application

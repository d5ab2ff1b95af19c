// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/sample_adder.h"

#include <algorithm>

namespace source_core {

namespace {

// Fewer are added sooner than a thread has started.
constexpr size_t FEWEST_PIXELS = size_t{1} << 14;

}  // namespace

std::span<glm::vec4> SampleAdder::room() {
    if (next_ == 1 && second_.empty()) {
        second_.resize(sums_.size());
        rooms_[1] = second_;
    }
    return rooms_[next_];
}

void SampleAdder::add() {
    parts_.clear();
    const glm::vec4* picture = rooms_[next_].data();
    next_ = 1 - next_;
    if (sums_.size() <= FEWEST_PIXELS) {
        render_system::add_samples(sums_, squares_, picture);
        return;
    }
    const size_t share = std::max(FEWEST_PIXELS, (sums_.size() + threads_ - 1) / threads_);
    for (size_t begin = 0; begin < sums_.size(); begin += share) {
        const size_t count = std::min(share, sums_.size() - begin);
        parts_.push_back(std::async(std::launch::async, [=, this] {
            render_system::add_samples(sums_.subspan(begin, count),
                                       render_system::part_of_squares(squares_, begin, count), picture + begin);
        }));
    }
}

}  // namespace source_core

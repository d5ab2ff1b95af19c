// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/locate/path_log.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace application {

using render_system::PathKernel;
using render_system::PathStates;

namespace {

// A head is: the path's next step; kernel, whether the path goes on, which rows follow, segment; instance; primitive.
constexpr uint32_t NEXT = 0, MARKS = 1, INSTANCE = 2, PRIMITIVE = 3;
constexpr uint32_t KERNEL_MASK = 7, GOES_ON = 8, ROWS_SHIFT = 4, SEGMENT_SHIFT = 12;

}  // namespace

void PathLog::after(const PathStates& states) {
    for (const PathView& view : paths_of(states)) {
        const size_t pixel = size_t{states.first_pixel} + view.path;
        if (pixel < first_.size()) keep(pixel, states, view);
    }
}

void PathLog::keep(size_t pixel, const PathStates& states, const PathView& view) {
    if (blocks_.size() + 1 + PATH_ROWS >= END) throw std::bad_alloc();
    const auto place = static_cast<uint32_t>(blocks_.size());
    uint32_t marks =
        static_cast<uint32_t>(states.kernel) | (view.goes_on ? GOES_ON : 0) | states.segment << SEGMENT_SHIFT;
    blocks_.emplace_back();
    for (uint32_t row = 0; row < PATH_ROWS; ++row) {
        if (!view.rows[row]) continue;
        marks |= 1u << (ROWS_SHIFT + row);
        std::memcpy(blocks_.emplace_back().data(), view.rows[row], sizeof(Block));
    }
    const auto bits = [](uint32_t number) { return std::bit_cast<float>(number); };
    blocks_[place] = {bits(END), bits(marks), bits(view.instance), bits(view.primitive)};
    if (last_[pixel] == END)
        first_[pixel] = place;
    else
        blocks_[last_[pixel]][NEXT] = bits(place);
    last_[pixel] = place;
}

void PathLog::clear() {
    blocks_.clear();
    std::fill(first_.begin(), first_.end(), END);
    std::fill(last_.begin(), last_.end(), END);
}

std::optional<PathLog::Step> PathLog::take_step(size_t pixel) {
    const uint32_t place = first_[pixel];
    if (place == END) return std::nullopt;
    first_[pixel] = word(place, NEXT);
    const uint32_t marks = word(place, MARKS);
    Step step{static_cast<PathKernel>(marks & KERNEL_MASK), marks >> SEGMENT_SHIFT, {}};
    step.view.instance = word(place, INSTANCE);
    step.view.primitive = word(place, PRIMITIVE);
    step.view.goes_on = (marks & GOES_ON) != 0;
    uint32_t block = place;
    for (uint32_t row = 0; row < PATH_ROWS; ++row)
        if (marks >> (ROWS_SHIFT + row) & 1u) step.view.rows[row] = blocks_[++block].data();
    return step;
}

}  // namespace application

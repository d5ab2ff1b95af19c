// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render_system/pixel_sum.h"

namespace source_core {

/// Adds pictures of one sample each to sums, on host threads, while the device takes the next one: on a GPU adding a
/// picture on one thread takes several times as long as tracing it. The end of the adder waits for all of them.
class SampleAdder {
public:
    /// `squares`: none, or as many as `sums`. `first` has room for a picture of these pixels; from the second picture
    /// on another of that size is allocated. `threads`: at least 1.
    SampleAdder(std::span<render_system::PixelSum> sums, std::span<double> squares, std::span<glm::vec4> first,
                uint32_t threads)
        : sums_(sums), squares_(squares), rooms_{first, {}}, threads_(threads) {}

    /// Where the next picture goes: a room that is not being read.
    std::span<glm::vec4> room();

    /// Begins to add what was written to the room given last. Waits for the picture before.
    void add();

private:
    std::span<render_system::PixelSum> sums_;
    std::span<double> squares_;
    std::span<glm::vec4> rooms_[2];
    std::vector<glm::vec4> second_;
    uint32_t threads_;
    uint32_t next_ = 0;                     // of the rooms
    std::vector<std::future<void>> parts_;  // each waits as it ends; last, so that it ends first
};

}  // namespace source_core

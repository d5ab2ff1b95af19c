// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "application/locate/path_fields.h"

namespace application {

/// Keeps what one core's kernels leave of every path of one sample: about 800 bytes a path of the usual length.
class PathLog final : public render_system::PathWatch {
public:
    /// A path after a kernel. `view` points into the log.
    struct Step {
        render_system::PathKernel kernel;
        uint32_t segment;
        PathView view;
    };

    explicit PathLog(size_t pixels) : first_(pixels, END), last_(pixels, END) {}

    /// From one thread.
    void after(const render_system::PathStates& states) override;

    /// Forgets the sample.
    void clear();

    /// The steps of a pixel's path one after the other; none at the end. May be asked of several pixels at once.
    std::optional<Step> take_step(size_t pixel);

private:
    using Block = std::array<float, 4>;  // of a head: words as bits
    static constexpr uint32_t END = 0xFFFFFFFFu;

    uint32_t word(uint32_t place, uint32_t which) const { return std::bit_cast<uint32_t>(blocks_[place][which]); }
    void keep(size_t pixel, const render_system::PathStates& states, const PathView& view);

    std::vector<uint32_t> first_;  // of each pixel: the step to take next
    std::vector<uint32_t> last_;
    std::vector<Block> blocks_;  // of each step: a head, then its rows
};

}  // namespace application

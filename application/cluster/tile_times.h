// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>

namespace application {

/// When a rank had which tile, for whoever wants to know where a team's time goes: a line a tile in the file that
/// PATHTRACER_TILE_TIMES names, with the rank's number behind it: "round first count" and four times, in seconds of the
/// machine's steady clock: the tile is given, its sums are asked for, its samples are taken, its sums are on their way
/// back. Without that variable nothing is written, and no clock read.
class TileTimes {
public:
    explicit TileTimes(int rank);

    void begin_round() { ++round_; }
    void begin_tile(uint64_t first_pixel, uint64_t count);
    /// One of the four.
    void note();
    void end_tile();

private:
    std::ofstream file_;
    uint64_t round_ = 0;
};

}  // namespace application

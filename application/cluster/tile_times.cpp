// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/cluster/tile_times.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

namespace application {
TileTimes::TileTimes(int rank) {
    if (const char* name = std::getenv("PATHTRACER_TILE_TIMES")) file_.open(fmt::format("{}.{}", name, rank));
}

void TileTimes::begin_tile(uint64_t first_pixel, uint64_t count) {
    if (!file_.is_open()) return;
    file_ << fmt::format("{} {} {}", round_, first_pixel, count);
    note();
}

void TileTimes::note() {
    if (!file_.is_open()) return;
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    file_ << fmt::format(" {:.6f}", std::chrono::duration<double>(now).count());
}

void TileTimes::end_tile() {
    note();
    if (file_.is_open()) file_ << '\n' << std::flush;
}

}  // namespace application

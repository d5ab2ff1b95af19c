// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "application/picture.h"
#include "application/stats_report.h"
#include "metrics/image/bias.h"

namespace application {

/// A test for bias, and what it was made of.
struct BiasReport {
    metrics::BiasQuestion question;
    metrics::BiasTest test;
    metrics::TileGrid grid;
    size_t batches_a = 0;
    size_t batches_b = 0;
    double mean = 0;              ///< of all of both pictures
    uint64_t samples_needed = 0;  ///< in `unit`, on each side
    bool at_least = false;        ///< more cannot be said: there is no spread to tell it from
    std::string unit;             ///< "samples" or "files"
    std::string name_a = "a", name_b = "b";
};

/// Rounded up, and at most 1e15: numbers in JSON stay exact.
uint64_t whole_count(double value);

/// The object `bias` of the contract, with what stands behind it.
Json bias_json(const BiasReport& report);

/// The same for a person, a few lines.
std::string bias_text(const BiasReport& report);

/// The tiles as a picture: red where b is brighter, blue where it is darker, the fuller the less chance explains it;
/// tiles that differ are bright, the others at half. Black: within the noise.
Channels<uint8_t> bias_map(const BiasReport& report);

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "metrics/image/tile_means.h"

// Bias told from noise. Two renderers of one scene, each with independent random numbers, give other pictures; if they
// mean the same picture, the difference of their means shrinks with the samples and stays within its standard error.

namespace metrics {

/// What a comparison is held to.
struct BiasQuestion {
    double alpha = 0.001;       ///< at most so often equal renderers are called different
    double resolution = 0.01;   ///< of the picture's mean: a bias of which `agree` means that it would have been found
    double allowance = 0.0001;  ///< of a tile's mean: what rounding may make of equal formulas, and no bias
};

inline constexpr size_t kFewestPictures = 16;  ///< a side, for a verdict

enum class BiasVerdict {
    agree,    ///< no difference; a bias of the resolution would have been found in 9 of 10 comparisons
    differ,   ///< the means differ
    too_few,  ///< neither: the pictures are too few, or too noisy
};

/// One tile, in the channel that differs most.
struct TileBias {
    size_t channel = 0;
    double difference = 0;  ///< b - a
    double standard_error = 0;
    double p_value = 1;  ///< of this test alone
    bool differs = false;
};

struct BiasTest {
    BiasVerdict verdict = BiasVerdict::too_few;
    double p_value = 1;  ///< corrected: below alpha in a share alpha of the comparisons of equal renderers
    size_t tiles_different = 0;
    double mean_difference = 0;            ///< of the whole picture and all channels, b - a
    double standard_error = 0;             ///< of that; 0 below two pictures a side
    double tile_level = 0;                 ///< a tile differs below this p-value
    std::optional<double> detectable;      ///< bias, as a share of the mean, that is found in 9 of 10; none: unknown
    std::optional<double> samples_needed;  ///< for `resolution`, as a multiple of those taken; none: unknown
    std::vector<TileBias> tiles;           ///< one for each of the grid; empty below two pictures a side
};

/// Welch's t-test (welch.h) of every tile and of the whole picture, channel by channel, each picture of a set being one
/// value. Sidak's correction is nested: the tiles together weigh as much as the whole picture. Both sets have one grid.
BiasTest test_bias(const TileMeans& a, const TileMeans& b, const BiasQuestion& question = {});

}  // namespace metrics

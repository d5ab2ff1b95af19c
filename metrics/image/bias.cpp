// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/image/bias.h"

#include <algorithm>
#include <cmath>

#include "metrics/statistics/sidak.h"
#include "metrics/statistics/student.h"
#include "metrics/statistics/welch.h"

namespace metrics {
namespace {

constexpr size_t kFamilies = 2;  // the tiles, and the whole picture
// A standard error from 16 pictures is itself off by an eighth, so more is asked for than it says.
constexpr double kMargin = 1.25;

double brightest(const MeanDifference& means) { return std::max(std::abs(means.mean_a), std::abs(means.mean_b)); }

/// The channel of a tile with the smallest p-value.
TileBias worst_channel(const TileMeans& a, const TileMeans& b, size_t tile, double allowance) {
    TileBias worst;
    worst.p_value = 2;
    for (size_t channel = 0; channel < CHANNELS; ++channel) {
        const MeanDifference means = mean_difference(a.values(tile, channel), b.values(tile, channel));
        const double p = p_value(means, allowance * brightest(means));
        if (p < worst.p_value) worst = {channel, means.difference(), means.standard_error, p, false};
    }
    return worst;
}

/// The bias of the whole picture that is found in 9 of 10 comparisons, as a share of the mean, in the worst channel.
double detectable_bias(const TileMeans& a, const TileMeans& b, const BiasQuestion& question) {
    constexpr double kMissed = 0.1;
    const double level = sidak_level(sidak_level(question.alpha, kFamilies), CHANNELS);
    const bool enough = std::min(a.pictures(), b.pictures()) >= kFewestPictures;
    double worst = 0;
    for (size_t channel = 0; channel < CHANNELS; ++channel) {
        const size_t whole = a.grid().tiles();
        const MeanDifference means = mean_difference(a.values(whole, channel), b.values(whole, channel));
        if (!(means.standard_error > 0)) continue;
        // Below that it is foretold for so many as a verdict takes.
        const double freedom = enough ? means.degrees_of_freedom : 2 * (kFewestPictures - 1);
        const double errors = student_critical(level, freedom) + student_critical(2 * kMissed, freedom);
        worst = std::max(worst, question.allowance + errors * means.standard_error / brightest(means));
    }
    return worst;
}

std::vector<double> mean_of_channels(const TileMeans& means) {
    const size_t whole = means.grid().tiles();
    std::vector<double> result(means.pictures());
    for (size_t channel = 0; channel < CHANNELS; ++channel) {
        const auto values = means.values(whole, channel);
        for (size_t i = 0; i < result.size(); ++i) result[i] += values[i] / static_cast<double>(CHANNELS);
    }
    return result;
}

/// Mean difference of the whole; without an error where one side is a single picture.
void add_means(const TileMeans& a, const TileMeans& b, BiasTest& test) {
    const std::vector<double> of_a = mean_of_channels(a), of_b = mean_of_channels(b);
    if (of_a.empty() || of_b.empty()) return;
    if (of_a.size() > 1 && of_b.size() > 1) {
        const MeanDifference means = mean_difference(of_a, of_b);
        test.mean_difference = means.difference();
        test.standard_error = means.standard_error;
        return;
    }
    const auto mean = [](const std::vector<double>& values) {
        double sum = 0;
        for (const double value : values) sum += value;
        return sum / static_cast<double>(values.size());
    };
    test.mean_difference = mean(of_b) - mean(of_a);
}

}  // namespace

BiasTest test_bias(const TileMeans& a, const TileMeans& b, const BiasQuestion& question) {
    BiasTest test;
    add_means(a, b, test);
    const size_t fewer = std::min(a.pictures(), b.pictures());
    if (fewer < 2) return test;

    const size_t tiles = a.grid().tiles();
    test.tile_level = sidak_level(sidak_level(question.alpha, kFamilies), tiles * CHANNELS);
    double smallest = 1;
    for (size_t tile = 0; tile < tiles; ++tile) {
        TileBias bias = worst_channel(a, b, tile, question.allowance);
        bias.differs = bias.p_value < test.tile_level;
        test.tiles_different += bias.differs ? 1 : 0;
        smallest = std::min(smallest, bias.p_value);
        test.tiles.push_back(bias);
    }
    const double whole = worst_channel(a, b, tiles, question.allowance).p_value;
    test.p_value =
        sidak_p_value(std::min(sidak_p_value(smallest, tiles * CHANNELS), sidak_p_value(whole, CHANNELS)), kFamilies);

    test.detectable = detectable_bias(a, b, question);
    const double ratio = *test.detectable / question.resolution;
    test.samples_needed = ratio * ratio * (ratio > 1 ? kMargin : 1);
    if (fewer < kFewestPictures) return test;
    test.verdict = test.p_value < question.alpha ? BiasVerdict::differ
                   : ratio <= 1                  ? BiasVerdict::agree
                                                 : BiasVerdict::too_few;
    return test;
}

}  // namespace metrics

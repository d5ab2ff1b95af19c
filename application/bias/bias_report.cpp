// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/bias/bias_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace application {
namespace {

using metrics::BiasVerdict;
using metrics::TileBias;

/// A tile's place and size in pixels.
struct TileBox {
    size_t x, y, width, height;
};

TileBox box_of(const metrics::TileGrid& grid, size_t tile) {
    const size_t x = tile % grid.columns() * grid.side, y = tile / grid.columns() * grid.side;
    return {x, y, std::min(grid.side, grid.width - x), std::min(grid.side, grid.height - y)};
}

/// The tile that differs most; none where no tile was tested.
const TileBias* worst_tile(const BiasReport& report) {
    const auto& tiles = report.test.tiles;
    const auto worst = std::min_element(tiles.begin(), tiles.end(),
                                        [](const TileBias& a, const TileBias& b) { return a.p_value < b.p_value; });
    return worst == tiles.end() ? nullptr : &*worst;
}

constexpr const char* kChannelNames[] = {"red", "green", "blue"};

Json worst_json(const BiasReport& report) {
    const TileBias* worst = worst_tile(report);
    if (worst == nullptr) return nullptr;
    const TileBox box = box_of(report.grid, static_cast<size_t>(worst - report.test.tiles.data()));
    return {{"box", {box.x, box.y, box.width, box.height}},
            {"channel", kChannelNames[worst->channel]},
            {"difference", worst->difference},
            {"standard_error", worst->standard_error},
            {"p_value", worst->p_value}};
}

const char* verdict_name(BiasVerdict verdict) {
    return verdict == BiasVerdict::agree ? "agree" : verdict == BiasVerdict::differ ? "differ" : "too_few";
}

std::string percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

}  // namespace

uint64_t whole_count(double value) {
    constexpr double kMost = 1e15;
    return static_cast<uint64_t>(std::ceil(std::clamp(value, 0.0, kMost)));
}

Json bias_json(const BiasReport& report) {
    const metrics::BiasTest& test = report.test;
    const bool tested = !test.tiles.empty();  // one picture a side has no spread
    const bool known = test.detectable && std::isfinite(*test.detectable);
    return {{"verdict", verdict_name(test.verdict)},
            {"p_value", tested ? Json(test.p_value) : Json(nullptr)},
            {"tiles", report.grid.tiles()},
            {"tiles_different", test.tiles_different},
            {"mean_difference", test.mean_difference},
            {"standard_error", tested ? Json(test.standard_error) : Json(nullptr)},
            {"samples_needed", report.samples_needed},
            {"alpha", report.question.alpha},
            {"resolution", report.question.resolution},
            {"detectable", known ? Json(*test.detectable) : Json(nullptr)},
            {"mean", report.mean},
            {"batches", {report.batches_a, report.batches_b}},
            {"tile_side", report.grid.side},
            {"worst_tile", worst_json(report)}};
}

std::string bias_text(const BiasReport& report) {
    const metrics::BiasTest& test = report.test;
    std::string text =
        fmt::format("bias: {}\n  {} - {}: {:+.3e} of {:.3e} in the mean",
                    test.verdict == BiasVerdict::too_few ? "too few to tell" : verdict_name(test.verdict),
                    report.name_b, report.name_a, test.mean_difference, report.mean);
    const std::string made_of =
        fmt::format("({} and {} {})", report.batches_a, report.batches_b, report.unit == "files" ? "files" : "batches");
    if (test.tiles.empty()) {
        text += fmt::format(" {}; one picture a side says nothing of the noise\n", made_of);
    } else {
        text += fmt::format(", standard error {:.1e} {}\n", test.standard_error, made_of);
        text += fmt::format(
            "  p = {:.2g} at alpha {:g}, corrected for {} tiles of {} pixels a side; {} of them differ\n", test.p_value,
            report.question.alpha, report.grid.tiles(), report.grid.side, test.tiles_different);
    }
    if (test.detectable)
        text += fmt::format("  a bias of {} of the picture would be found in 9 of 10 such comparisons\n",
                            percent(*test.detectable));
    if (const TileBias* worst = worst_tile(report); worst != nullptr && test.verdict == BiasVerdict::differ) {
        const TileBox box = box_of(report.grid, static_cast<size_t>(worst - test.tiles.data()));
        text += fmt::format("  most at {},{} ({}x{}): {:+.3e} of {}, standard error {:.1e}\n", box.x, box.y, box.width,
                            box.height, worst->difference, kChannelNames[worst->channel], worst->standard_error);
    }
    if (test.verdict == BiasVerdict::too_few)
        text += fmt::format("  to find a bias of {}: {}{} {} on each side\n", percent(report.question.resolution),
                            report.at_least ? "at least " : "", report.samples_needed, report.unit);
    return text;
}

Channels<uint8_t> bias_map(const BiasReport& report) {
    const metrics::TileGrid& grid = report.grid;
    Channels<uint8_t> map{static_cast<uint32_t>(grid.width), static_cast<uint32_t>(grid.height),
                          std::vector<uint8_t>(grid.width * grid.height * metrics::CHANNELS)};
    if (report.test.tiles.empty()) return map;
    constexpr double kLeast = 1e-300;
    for (size_t y = 0; y < grid.height; ++y) {
        for (size_t x = 0; x < grid.width; ++x) {
            const TileBias& tile = report.test.tiles[grid.tile_of(x, y)];
            const double unlikely = std::log(std::max(tile.p_value, kLeast)) / std::log(report.test.tile_level);
            const auto shade = static_cast<uint8_t>(tile.differs ? 255 : std::lround(127.0 * std::min(unlikely, 1.0)));
            map.rgb[(y * grid.width + x) * metrics::CHANNELS + (tile.difference > 0 ? 0 : 2)] = shade;
        }
    }
    return map;
}

}  // namespace application

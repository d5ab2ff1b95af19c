// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/stats_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stats_report_test {
namespace {

using namespace application;
using render_system::CoreStats;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> keys(const Json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
}

CoreStats stats_after(uint64_t samples) {
    CoreStats stats;
    stats.core = "target";
    stats.device = "a device";
    stats.triangles = 12;
    stats.threads = 2;
    stats.samples = samples;
    stats.primary_rays = 1000 * samples;
    stats.extension_rays = 2000 * samples;
    stats.shadow_rays = 500 * samples;
    stats.build_ms = 3.0;
    stats.generate_ms = 1.0 * static_cast<double>(samples);
    stats.extend_ms = 4.0 * static_cast<double>(samples);
    stats.shade_ms = 2.0 * static_cast<double>(samples);
    stats.connect_ms = 3.0 * static_cast<double>(samples);
    stats.finalize_ms = 0.5 * static_cast<double>(samples);
    stats.total_ms = 10.5 * static_cast<double>(samples);
    return stats;
}

TEST(FrameFigures, AreTheDifferencePerSample) {
    const FrameFigures frame = frame_between(stats_after(3), stats_after(7));
    EXPECT_DOUBLE_EQ(frame.primary_rays, 1000.0);
    EXPECT_DOUBLE_EQ(frame.connect_ms, 3.0);
    EXPECT_DOUBLE_EQ(frame.total_ms, 10.5);
    EXPECT_DOUBLE_EQ(mean_frame(stats_after(5)).extend_ms, 4.0);
}

TEST(FrameFigures, TypicalTakesMediansOfTimesAndMeansOfCounts) {
    std::vector<FrameFigures> frames(3);
    for (size_t i = 0; i < 3; ++i) {
        const double slow[] = {10.0, 1000.0, 12.0};
        frames[i].total_ms = slow[i];
        frames[i].shadow_rays = static_cast<double>(i);
    }
    EXPECT_DOUBLE_EQ(typical_frame(frames).total_ms, 12.0);
    EXPECT_DOUBLE_EQ(typical_frame(frames).shadow_rays, 1.0);
    frames.pop_back();
    EXPECT_DOUBLE_EQ(typical_frame(frames).total_ms, 505.0);
}

TEST(BenchJson, HasTheFieldsOfTheContract) {
    Options options;
    options.scene = "a.gltf";
    const Json bench = bench_json(options, stats_after(4), {}, mean_frame(stats_after(4)), 4);
    EXPECT_THAT(keys(bench), ElementsAre("core", "device", "scene", "triangles", "threads", "roulette", "bvh_build_ms",
                                         "frames", "paths_per_s", "rays", "ms_per_frame", "mrays_per_s",
                                         "embree_limit_mrays_per_s", "embree_limit_ms", "embree_build_ms",
                                         "embree_memory_bytes", "texel_bytes", "core_memory_bytes", "peak_rss_bytes"));
    EXPECT_THAT(keys(bench["rays"]), ElementsAre("primary", "extension", "shadow", "total"));
    EXPECT_THAT(keys(bench["ms_per_frame"]),
                ElementsAre("generate", "extend", "shade", "connect", "finalize", "total"));
    EXPECT_THAT(keys(bench["mrays_per_s"]), ElementsAre("trace", "total"));
    EXPECT_EQ(bench["rays"]["total"], 3500);
    EXPECT_DOUBLE_EQ(bench["paths_per_s"].get<double>(), 1000.0 / 10.5e-3);
    EXPECT_DOUBLE_EQ(bench["mrays_per_s"]["total"].get<double>(), 3500.0 / 10.5e-3 * 1e-6);
    EXPECT_DOUBLE_EQ(bench["mrays_per_s"]["trace"].get<double>(), 3500.0 / 7e-3 * 1e-6);
    EXPECT_TRUE(bench["embree_limit_ms"].is_null());
    EXPECT_GT(bench["peak_rss_bytes"].get<uint64_t>(), 1000000u);
}

TEST(BenchJson, StatesTheEmbreeLimitWhereItWasMeasured) {
    FrameFigures frame = mean_frame(stats_after(4));
    frame.trace_limit_rays = 3500.0;
    frame.trace_limit_ms = 0.25;
    const Json bench = bench_json(Options{}, stats_after(4), {}, frame, 4);
    EXPECT_DOUBLE_EQ(bench["embree_limit_mrays_per_s"].get<double>(), 14.0);
    EXPECT_DOUBLE_EQ(bench["embree_limit_ms"].get<double>(), 0.25);
    EXPECT_THAT(bench_text(bench), HasSubstr("14.00 Mrays/s in 0.25 ms on the very same rays"));
}

TEST(BenchJson, StatesEmbreesShareOfBuildAndMemory) {
    CoreStats stats = stats_after(4);
    stats.build_ms = 12.0;
    stats.memory_bytes = 32u << 20;
    stats.texel_bytes = 8u << 20;
    const render_system::EmbreeFigures embree{.build_ms = 10.0, .memory_bytes = 16u << 20};
    const Json bench = bench_json(Options{}, stats, embree, mean_frame(stats), 4);
    EXPECT_DOUBLE_EQ(bench["embree_build_ms"].get<double>(), 10.0);
    EXPECT_EQ(bench["embree_memory_bytes"], 16u << 20);
    EXPECT_THAT(bench_text(bench), HasSubstr("BVH in 12.0 ms, 10.0 of them Embree's"));
    EXPECT_THAT(bench_text(bench), HasSubstr("the core 32 MiB, of that Embree's scene 16 MiB and texels 8 MiB"));
}

TEST(BenchJson, WithoutTimesHasNoRates) {
    const Json bench = bench_json(Options{}, CoreStats{}, {}, FrameFigures{}, 0);
    EXPECT_TRUE(bench["paths_per_s"].is_null());
    EXPECT_TRUE(bench["mrays_per_s"]["total"].is_null());
    EXPECT_THAT(bench_text(bench), Not(HasSubstr("Embree")));
}

TEST(StatsJson, AddsWhatWasAskedFor) {
    Options options;
    options.seed = 9;
    const Json stats =
        stats_json(bench_json(options, stats_after(1), {}, mean_frame(stats_after(1)), 1), options, 16, "why");
    EXPECT_EQ(stats["size"], Json::array({640, 360}));
    EXPECT_EQ(stats["spp"], 16);
    EXPECT_EQ(stats["seed"], 9);
    EXPECT_EQ(stats["core_reason"], "why");
}

}  // namespace
}  // namespace stats_report_test

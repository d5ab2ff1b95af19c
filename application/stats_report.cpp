// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/stats_report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>

namespace application {
namespace {

using render_system::CoreStats;

constexpr double BYTES_PER_MEBIBYTE = 1024.0 * 1024.0;

/// Every time of a frame, so that they can be walked through.
constexpr double FrameFigures::*TIMES[] = {
    &FrameFigures::generate_ms, &FrameFigures::extend_ms, &FrameFigures::shade_ms,       &FrameFigures::connect_ms,
    &FrameFigures::finalize_ms, &FrameFigures::total_ms,  &FrameFigures::trace_limit_ms,
};
constexpr double FrameFigures::*COUNTS[] = {
    &FrameFigures::primary_rays,
    &FrameFigures::extension_rays,
    &FrameFigures::shadow_rays,
    &FrameFigures::trace_limit_rays,
};

FrameFigures figures(const CoreStats& stats) {
    return {.primary_rays = static_cast<double>(stats.primary_rays),
            .extension_rays = static_cast<double>(stats.extension_rays),
            .shadow_rays = static_cast<double>(stats.shadow_rays),
            .generate_ms = stats.generate_ms,
            .extend_ms = stats.extend_ms,
            .shade_ms = stats.shade_ms,
            .connect_ms = stats.connect_ms,
            .finalize_ms = stats.finalize_ms,
            .total_ms = stats.total_ms};
}

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

std::vector<double> column(const std::vector<FrameFigures>& frames, double FrameFigures::*field) {
    std::vector<double> values;
    values.reserve(frames.size());
    for (const FrameFigures& frame : frames) values.push_back(frame.*field);
    return values;
}

/// Millions a second; null where no time was measured.
Json mega_per_second(double count, double milliseconds) {
    if (milliseconds <= 0.0) return nullptr;
    return count / milliseconds * 1e-3;
}

std::string number_or_dash(const Json& value, const char* unit) {
    return value.is_null() ? "-" : fmt::format("{:.2f} {}", value.get<double>(), unit);
}

}  // namespace

FrameFigures frame_between(const CoreStats& before, const CoreStats& after) {
    const FrameFigures first = figures(before);
    const auto samples = static_cast<double>(std::max<uint64_t>(1, after.samples - before.samples));
    FrameFigures frame = figures(after);
    for (const auto field : TIMES) frame.*field = (frame.*field - first.*field) / samples;
    for (const auto field : COUNTS) frame.*field = (frame.*field - first.*field) / samples;
    return frame;
}

FrameFigures mean_frame(const CoreStats& stats) { return frame_between(CoreStats{}, stats); }

FrameFigures typical_frame(const std::vector<FrameFigures>& frames) {
    FrameFigures typical;
    for (const auto field : TIMES) typical.*field = median(column(frames, field));
    for (const auto field : COUNTS) typical.*field = mean(column(frames, field));
    return typical;
}

Json bench_json(const Options& options, const CoreStats& stats, const render_system::EmbreeFigures& embree,
                const FrameFigures& frame, uint64_t frames) {
    const auto primary = std::llround(frame.primary_rays);
    const auto extension = std::llround(frame.extension_rays);
    const auto shadow = std::llround(frame.shadow_rays);
    const auto total = primary + extension + shadow;
    const bool has_limit = frame.trace_limit_rays > 0.0 && frame.trace_limit_ms > 0.0;
    const Json paths = mega_per_second(frame.primary_rays, frame.total_ms);
    return {
        {"core", stats.core},
        {"device", stats.device},
        {"scene", options.scene},
        {"triangles", stats.triangles},
        {"threads", stats.threads},
        {"roulette", options.russian_roulette},
        {"bvh_build_ms", stats.build_ms},
        {"frames", frames},
        {"paths_per_s", paths.is_null() ? paths : Json(paths.get<double>() * 1e6)},
        {"rays", {{"primary", primary}, {"extension", extension}, {"shadow", shadow}, {"total", total}}},
        {"ms_per_frame",
         {{"generate", frame.generate_ms},
          {"extend", frame.extend_ms},
          {"shade", frame.shade_ms},
          {"connect", frame.connect_ms},
          {"finalize", frame.finalize_ms},
          {"total", frame.total_ms}}},
        {"mrays_per_s",
         {{"trace", mega_per_second(static_cast<double>(total), frame.extend_ms + frame.connect_ms)},
          {"total", mega_per_second(static_cast<double>(total), frame.total_ms)}}},
        {"embree_limit_mrays_per_s",
         has_limit ? mega_per_second(frame.trace_limit_rays, frame.trace_limit_ms) : Json(nullptr)},
        {"embree_limit_ms", has_limit ? Json(frame.trace_limit_ms) : Json(nullptr)},
        {"embree_build_ms", embree.build_ms > 0.0 ? Json(embree.build_ms) : Json(nullptr)},
        {"embree_memory_bytes", embree.memory_bytes > 0 ? Json(embree.memory_bytes) : Json(nullptr)},
        {"texel_bytes", stats.texel_bytes},
        {"core_memory_bytes", stats.memory_bytes},
        {"peak_rss_bytes", peak_rss_bytes()},
    };
}

Json stats_json(Json bench, const Options& options, uint32_t spp, const std::string& core_reason) {
    bench["size"] = {options.width, options.height};
    bench["spp"] = spp;
    bench["seed"] = options.seed;
    bench["core_reason"] = core_reason;
    return bench;
}

std::string bench_text(const Json& bench) {
    const Json& rays = bench["rays"];
    const Json& ms = bench["ms_per_frame"];
    const Json& rate = bench["mrays_per_s"];
    std::string text = fmt::format("{} core on {}, {} threads\n", bench["core"].get<std::string>(),
                                   bench["device"].get<std::string>(), bench["threads"].get<uint64_t>());
    const std::string by_embree =
        bench["embree_build_ms"].is_null()
            ? ""
            : fmt::format(", {:.1f} of them Embree's", bench["embree_build_ms"].get<double>());
    text += fmt::format("scene       {}, {} triangles, BVH in {:.1f} ms{}\n", bench["scene"].get<std::string>(),
                        bench["triangles"].get<uint64_t>(), bench["bvh_build_ms"].get<double>(), by_embree);
    text +=
        fmt::format("rays/frame  {} = {} primary + {} extension + {} shadow\n", rays["total"].get<int64_t>(),
                    rays["primary"].get<int64_t>(), rays["extension"].get<int64_t>(), rays["shadow"].get<int64_t>());
    text += fmt::format(
        "ms/frame    {:.2f} (generate {:.2f}, extend {:.2f}, shade {:.2f}, connect {:.2f}, finalize {:.2f}), "
        "median of {}\n",
        ms["total"].get<double>(), ms["generate"].get<double>(), ms["extend"].get<double>(), ms["shade"].get<double>(),
        ms["connect"].get<double>(), ms["finalize"].get<double>(), bench["frames"].get<uint64_t>());
    text += fmt::format("speed       {} in all, {} in tracing\n", number_or_dash(rate["total"], "Mrays/s"),
                        number_or_dash(rate["trace"], "Mrays/s"));
    if (!bench["embree_limit_ms"].is_null()) {
        text += fmt::format("Embree      {} in {:.2f} ms on the very same rays\n",
                            number_or_dash(bench["embree_limit_mrays_per_s"], "Mrays/s"),
                            bench["embree_limit_ms"].get<double>());
    }
    const auto mebibytes = [&](const char* name) {
        return fmt::format("{:.0f} MiB", bench[name].get<double>() / BYTES_PER_MEBIBYTE);
    };
    text += fmt::format("memory      {} at most; the core {}, ", mebibytes("peak_rss_bytes"),
                        mebibytes("core_memory_bytes"));
    if (!bench["embree_memory_bytes"].is_null()) {
        text += fmt::format("of that Embree's scene {} and texels {}", mebibytes("embree_memory_bytes"),
                            mebibytes("texel_bytes"));
    } else {
        text += fmt::format("of that texels {}", mebibytes("texel_bytes"));
    }
    return text + "\n";
}

uint64_t peak_rss_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace application

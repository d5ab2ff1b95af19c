// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/locate/in_step.h"

#include <algorithm>
#include <new>
#include <set>

#include "application/progress_bar.h"

namespace application {

using render_system::Convergence;
using render_system::Result;
using render_system::Status;

namespace {

/// One of the two, with the picture it works on.
struct Walker {
    CoreSession session;
    Picture picture;
    std::string reason;
    CoreResult result;

    Walker(const Options& options, const SceneSetup& setup, Console& console)
        : session(options, setup, console), picture(options.width, options.height) {}

    /// The first sample, or the next.
    Status take_sample(const char* core, uint32_t sample) {
        if (sample > 1) return session.render(Convergence::Converge, 1);
        const auto choice = session.start({core}, picture);
        if (choice.ok()) reason = choice->reason;
        return choice.status;
    }
};

Result<InStep> walk(const std::array<const char*, 2>& cores, const Options& options, const SceneSetup& setup,
                    Console& console) {
    const size_t pixels = size_t{options.width} * options.height;
    PathLog log(pixels);
    PathComparison comparison(log, setup.scene, pixels, {options.exact ? 0.0f : NATIVE_TOLERANCE});
    std::array<Walker, 2> walkers = {Walker(options, setup, console), Walker(options, setup, console)};
    walkers[0].session.set_watch(&log);
    walkers[1].session.set_watch(&comparison);

    const std::set<uint32_t> counts(options.spp.begin(), options.spp.end());
    ProgressBar bar(console, "both");
    for (uint32_t sample = 1; sample <= *counts.rbegin(); ++sample) {
        uint64_t rays = 0;
        double seconds = 0.0;
        for (size_t i = 0; i < walkers.size(); ++i) {
            Walker& walker = walkers[i];
            if (Status status = walker.take_sample(cores[i], sample); !status.ok()) return status;
            if (counts.contains(sample)) walker.result.pictures.emplace(sample, walker.picture);
            const auto stats = walker.session.stats();
            rays += stats.primary_rays + stats.extension_rays + stats.shadow_rays;
            seconds += stats.total_ms * 1e-3;
        }
        comparison.finish_sample();
        bar.show(sample, *counts.rbegin(), rays, seconds);
    }

    InStep result;
    result.differences = comparison.differences();
    for (size_t i = 0; i < walkers.size(); ++i) {
        walkers[i].result.stats = core_stats(walkers[i].session, options, walkers[i].reason);
        result.cores[i] = std::move(walkers[i].result);
        const auto texts = walkers[i].session.kernel_texts();
        result.texts.insert(result.texts.end(), texts.begin(), texts.end());
    }
    return result;
}

}  // namespace

Json core_stats(CoreSession& session, const Options& options, const std::string& core_reason) {
    const auto stats = session.stats();
    const Json bench = bench_json(options, stats, session.embree_figures(), mean_frame(stats), stats.samples);
    return stats_json(bench, options, *std::max_element(options.spp.begin(), options.spp.end()), core_reason);
}

Result<InStep> render_in_step(const std::array<const char*, 2>& cores, const Options& options, const SceneSetup& setup,
                              Console& console) {
    try {
        return walk(cores, options, setup, console);
    } catch (const std::bad_alloc&) {
        return Status::invalid("--locate: the machine's memory is used up; give a smaller --size");
    }
}

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/take_samples.h"

#include <algorithm>
#include <bit>

#include "application/cluster/team.h"
#include "application/option_values.h"
#include "application/progress_bar.h"

namespace application {
namespace {

using render_system::CoreStats;
using render_system::Result;
using render_system::Status;
using Clock = std::chrono::steady_clock;

constexpr uint32_t kFewestForNoise = 8;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The counts at which noise is measured: all from 8 to 16, every other to 32, and so on.
uint32_t noise_step(uint32_t samples) { return std::max(1u, std::bit_floor(samples) / 8); }

bool measures_noise(const SamplingPlan& plan, uint32_t samples) {
    return plan.noise && samples >= kFewestForNoise && samples % noise_step(samples) == 0;
}

std::optional<SamplingEnd> end_of(const SamplingPlan& plan, const SampleSums& sums, double sample_seconds) {
    if (measures_noise(plan, sums.samples)) {
        plan.collect();
        if (noise_of(sums) <= *plan.noise) return SamplingEnd::noise;
    }
    if (sums.samples >= plan.wanted.count()) return SamplingEnd::all_taken;
    if (sums.samples == 0) return std::nullopt;
    if (plan.interrupt->signal() != 0) return SamplingEnd::interrupted;
    if (plan.time_limit && seconds_since(plan.start) + sample_seconds > *plan.time_limit)
        return SamplingEnd::time_limit;
    return std::nullopt;
}

/// How long the next call of the core is to take.
double portion_seconds(const SamplingPlan& plan, double seconds_taken) {
    const Portions& portions = plan.portions;
    const double seconds = std::clamp(seconds_taken / 5.0, portions.least_seconds, portions.most_seconds);
    return plan.checkpoint ? std::min(seconds, *plan.checkpoint) : seconds;
}

/// How many samples go into it, and none past a place where something is decided.
uint32_t portion(const SamplingPlan& plan, uint32_t samples, double sample_seconds, double seconds) {
    if (plan.time_limit) seconds = std::min(seconds, *plan.time_limit - seconds_since(plan.start));
    const double fitting = std::max(1.0, seconds / std::max(sample_seconds, 1e-9));
    uint32_t count = static_cast<uint32_t>(std::min<double>(fitting, plan.wanted.count() - samples));
    if (plan.noise) {
        const uint32_t step = samples < kFewestForNoise ? kFewestForNoise : noise_step(samples);
        count = std::min(count, step - samples % step);
    }
    return count;
}

}  // namespace

SampleRange wanted_samples(const Options& options) {
    const SamplingOptions& sampling = options.sampling;
    if (sampling.range) return {(*sampling.range)[0], (*sampling.range)[1]};
    const bool open = !options.spp_given && (sampling.time_limit || sampling.noise);
    return {0, open ? MAX_SAMPLES : options.spp.front()};
}

bool keeps_squares(const Options& options) {
    return options.sampling.noise.has_value() || options.filter != FilterMode::none;
}

Result<SamplingEnd> take_samples(CoreSession& session, SampleSums& sums, const SamplingPlan& plan, Console& console) {
    ProgressBar bar(console, plan.label.empty() ? session.stats().core : plan.label);
    Clock::time_point written = Clock::now();
    const CoreStats first = session.stats();
    // A session starts with a sample of the whole picture; a rank's with one pixel, which says nothing of a sample.
    uint32_t taken = sums.samples > 0 && !team() ? 1 : 0;
    double seconds = taken > 0 ? first.total_ms * 1e-3 : 0.0;  // that these took
    while (true) {
        const double sample_seconds = seconds / std::max(1u, taken);
        if (const auto end = end_of(plan, sums, sample_seconds)) return *end;
        const double next_seconds = portion_seconds(plan, seconds);
        const double at_work = std::max(sample_seconds, next_seconds);  // and lost where a kill comes then
        if (plan.checkpoint && sums.samples > 0 &&
            seconds_since(written) + std::min(at_work, *plan.checkpoint) > *plan.checkpoint) {
            plan.write_checkpoint();
            written = Clock::now();
        }
        // What a checkpoint brought counts as if it had taken as long as what came since.
        const CoreStats now = session.stats();
        const uint64_t rays = (now.primary_rays + now.extension_rays + now.shadow_rays) * sums.samples /
                              std::max<uint64_t>(1, now.samples);
        bar.show(sums.samples, plan.wanted.count(), rays, sample_seconds * sums.samples);
        const uint32_t count = taken == 0 ? 1 : portion(plan, sums.samples, sample_seconds, next_seconds);
        const Clock::time_point began = Clock::now();
        const Status status = plan.render(count);
        if (!status.ok()) return status;
        seconds += seconds_since(began);
        taken += count;
    }
}

}  // namespace application

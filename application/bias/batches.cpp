// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/bias/batches.h"

#include <algorithm>

#include "application/bias/bias_report.h"
#include "application/progress_bar.h"
#include "metrics/image/bias.h"

namespace application {

using render_system::Result;
using render_system::Status;

namespace {

constexpr uint32_t kBatches = 2 * metrics::kFewestPictures, kFewestForAll = 64;

}  // namespace

BatchPlan plan_batches(uint32_t samples) {
    const auto fewest = static_cast<uint32_t>(metrics::kFewestPictures);
    if (samples < fewest) return {samples, 1};
    const uint32_t batches = samples < kFewestForAll ? fewest : kBatches;
    return {batches, samples / batches};
}

uint64_t samples_of_plan(double samples) {
    const uint64_t batches = samples < kFewestForAll ? metrics::kFewestPictures : kBatches;
    return batches * std::max<uint64_t>(1, whole_count(samples / static_cast<double>(batches)));
}

uint32_t batch_seed(uint32_t seed, uint32_t core, uint32_t batch) {
    // The finalizer of SplitMix64 (Steele, Lea, Flood 2014), which is a bijection.
    uint64_t z = (uint64_t{seed} << 32 | uint64_t{core} << 31 | batch) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<uint32_t>((z ^ (z >> 31)) >> 32);
}

Result<BatchedRender> render_batches(CoreSession& session, const Picture& target, const BatchPlan& plan, uint32_t seed,
                                     uint32_t core, Console& console) {
    BatchedRender result{metrics::TileMeans(metrics::sixteen_along(target.width, target.height)),
                         Picture(target.width, target.height)};
    std::vector<glm::dvec4> sum(target.pixels.size(), glm::dvec4(0.0));
    ProgressBar bar(console, session.stats().core);
    uint64_t rays = 0;
    double seconds = 0.0;
    for (uint32_t batch = 0; batch < plan.batches; ++batch) {
        bar.show(batch * plan.samples, plan.total(), rays, seconds);
        if (Status status = session.restart(batch_seed(seed, core, batch), plan.samples); !status.ok()) return status;
        result.means.add(linear_values(target).view());
        for (size_t i = 0; i < sum.size(); ++i) sum[i] += glm::dvec4(target.pixels[i]);
        const auto stats = session.stats();
        rays += stats.primary_rays + stats.extension_rays + stats.shadow_rays;
        seconds += stats.total_ms * 1e-3;
    }
    for (size_t i = 0; i < sum.size(); ++i)
        result.picture.pixels[i] = glm::vec4(sum[i] / static_cast<double>(plan.batches));
    return result;
}

}  // namespace application

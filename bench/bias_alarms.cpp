// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// How often `compare --bias` raises an alarm where there is nothing to find: bias_alarms [COMPARISONS [WIDTH HEIGHT
// SPP]]. One core is compared with itself, each time with seeds that no other batch has. One process, so that a
// thousand comparisons take a minute and not the start of a thousand programs. Built on request: ninja bias_alarms.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "application/bias/batches.h"
#include "application/scene_setup.h"
#include "metrics/image/bias.h"

using namespace application;

namespace {

uint32_t argument(int count, char** words, int index, uint32_t otherwise) {
    return count > index ? static_cast<uint32_t>(std::strtoul(words[index], nullptr, 10)) : otherwise;
}

}  // namespace

int main(int count, char** words) {
    const uint32_t comparisons = argument(count, words, 1, 1000);
    Options options;
    options.scene = "still_life";
    options.width = argument(count, words, 2, 64);
    options.height = argument(count, words, 3, 36);
    const BatchPlan plan = plan_batches(argument(count, words, 4, 16));
    Console console(options, false, false);
    auto setup = set_up_scene(options, console);
    if (!setup.ok()) return 2;
    CoreSession session(options, std::move(*setup), console);
    Picture picture(options.width, options.height);
    if (!session.start({"target"}, picture).ok()) return 2;

    uint32_t alarms = 0;
    std::map<double, uint32_t> below = {{0.1, 0}, {0.01, 0}, {0.001, 0}};
    double lowest = 1;
    for (uint32_t seed = 1; seed <= comparisons; ++seed) {
        const auto a = render_batches(session, picture, plan, seed, 0, console);
        const auto b = render_batches(session, picture, plan, seed, 1, console);
        if (!a.ok() || !b.ok()) return 2;
        const metrics::BiasTest test = metrics::test_bias(a->means, b->means);
        alarms += test.verdict == metrics::BiasVerdict::differ ? 1 : 0;
        lowest = std::min(lowest, test.p_value);
        for (auto& [level, number] : below) number += test.p_value < level ? 1 : 0;
    }
    std::printf("%u alarms in %u comparisons; p below 0.1: %u, 0.01: %u, 0.001: %u; lowest %.2g\n", alarms, comparisons,
                below[0.1], below[0.01], below[0.001], lowest);
    return 1000 * alarms > 5 * comparisons ? 1 : 0;
}

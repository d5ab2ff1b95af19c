// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// How often `compare --bias` raises an alarm where there is nothing to find: bias_alarms [COMPARISONS [WIDTH HEIGHT
// SPP]]. One core is compared with itself, each time with seeds that no other batch has. One process, so that a
// thousand comparisons take a minute and not the start of a thousand programs. Built on request: ninja bias_alarms.
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <string>

#include "application/bias/batches.h"
#include "application/option_values.h"
#include "application/scene_setup.h"
#include "metrics/image/bias.h"

using namespace application;

namespace {

constexpr uint32_t MOST_COMPARISONS = 1'000'000;

/// One line; the exit code of a program that was asked for what it cannot do.
int refuse(const std::string& what, const render_system::Status& status) {
    std::fprintf(stderr, "bias_alarms: %s: %s\n", what.c_str(), status.message.c_str());
    return 2;
}

/// COMPARISONS, WIDTH, HEIGHT and SPP, as far as they are given.
Result<std::array<uint32_t, 4>> read_numbers(int count, char** words) {
    constexpr std::array<uint32_t, 4> most = {MOST_COMPARISONS, MAX_SIDE, MAX_SIDE, MAX_SAMPLES};
    std::array<uint32_t, 4> numbers = {1000, 64, 36, 16};
    if (count > 5) return render_system::Status::invalid("give COMPARISONS [WIDTH HEIGHT SPP]");
    for (int i = 1; i < count; ++i) {
        const auto number = parse_number(words[i], 1, most[i - 1]);
        if (!number.ok()) return number.status;
        numbers[i - 1] = *number;
    }
    const auto size = parse_size(std::to_string(numbers[1]) + "x" + std::to_string(numbers[2]));
    if (!size.ok()) return size.status;
    return numbers;
}

}  // namespace

int main(int count, char** words) {
    const auto numbers = read_numbers(count, words);
    if (!numbers.ok()) return refuse("arguments", numbers.status);
    const uint32_t comparisons = (*numbers)[0];
    Options options;
    options.scene = "still_life";
    options.width = (*numbers)[1];
    options.height = (*numbers)[2];
    const BatchPlan plan = plan_batches((*numbers)[3]);
    Console console(options, false, false);
    auto setup = set_up_scene(options, console);
    if (!setup.ok()) return refuse("still_life", setup.status);
    CoreSession session(options, std::move(*setup), console);
    Picture picture(options.width, options.height);
    if (const auto started = session.start({"target"}, picture); !started.ok()) return refuse("target", started.status);

    uint32_t alarms = 0;
    std::map<double, uint32_t> below = {{0.1, 0}, {0.01, 0}, {0.001, 0}};
    double lowest = 1;
    for (uint32_t seed = 1; seed <= comparisons; ++seed) {
        const auto a = render_batches(session, picture, plan, seed, 0, console);
        const auto b = render_batches(session, picture, plan, seed, 1, console);
        if (!a.ok() || !b.ok()) return refuse("batches", a.ok() ? b.status : a.status);
        const metrics::BiasTest test = metrics::test_bias(a->means, b->means);
        alarms += test.verdict == metrics::BiasVerdict::differ ? 1 : 0;
        lowest = std::min(lowest, test.p_value);
        for (auto& [level, number] : below) number += test.p_value < level ? 1 : 0;
    }
    std::printf("%u alarms in %u comparisons; p below 0.1: %u, 0.01: %u, 0.001: %u; lowest %.2g\n", alarms, comparisons,
                below[0.1], below[0.01], below[0.001], lowest);
    return 1000 * alarms > 5 * comparisons ? 1 : 0;
}

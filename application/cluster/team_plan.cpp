// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/cluster/team_plan.h"

#include <fmt/format.h>

#include "application/command_table.h"

namespace application {

RunIdentity team_plan(const Invocation& invocation) {
    RunIdentity plan;
    if (!invocation.command) {
        const std::string first_line = invocation.text.substr(0, invocation.text.find('\n'));
        plan.entries.emplace_back("the command", fmt::format("none ({})", first_line));
        return plan;
    }
    plan.entries.emplace_back("the command", invocation.command->name);
    const Options& options = invocation.options;
    const SamplingOptions& sampling = options.sampling;
    const auto add = [&](const char* name, std::string value) { plan.entries.emplace_back(name, std::move(value)); };
    add("--frames", options.frames ? fmt::format("{}:{}", options.frames->first, options.frames->end) : "none");
    add("--filter", name_of(options.filter));
    add("--spp", std::to_string(options.spp.front()));
    add("--samples", sampling.range ? fmt::format("{}:{}", (*sampling.range)[0], (*sampling.range)[1]) : "none");
    add("--noise", sampling.noise ? std::to_string(*sampling.noise) : "none");
    add("--resume", options.resume ? "given" : "not given");
    if (!options.frames) return plan;
    // Each member writes the frames that it gets.
    add("-o", options.output);
    add("--fps", std::to_string(options.fps));
    add("--exposure", std::to_string(options.exposure));
    add("--tone-map", std::to_string(static_cast<int>(options.tone_map)));
    return plan;
}

}  // namespace application

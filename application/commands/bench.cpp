// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "application/commands/command_steps.h"
#include "application/commands/commands.h"
#include "application/file_output.h"
#include "application/progress_bar.h"

namespace application {
namespace {

using render_system::Convergence;
using render_system::CoreStats;
using render_system::Result;
using render_system::Status;

/// Times `count` frames of one sample each, from the first sample on. What a core does once (compiling, building) has
/// been done by the frame that started it.
Result<std::vector<FrameFigures>> time_frames(CoreSession& session, uint32_t count, Console& console,
                                              const std::string& label) {
    std::vector<FrameFigures> frames;
    ProgressBar bar(console, label);
    CoreStats before;
    for (uint32_t frame = 0; frame < count; ++frame) {
        const auto convergence = frame == 0 ? Convergence::Restart : Convergence::Converge;
        if (Status status = session.render(convergence, 1); !status.ok()) return status;
        const CoreStats after = session.stats();
        frames.push_back(frame_between(before, after));
        const render_system::EmbreeFigures embree = session.embree_figures();
        frames.back().trace_limit_rays = static_cast<double>(embree.limit_rays);
        frames.back().trace_limit_ms = embree.limit_ms;
        before = after;
        bar.show(frame + 1, count, after.primary_rays + after.extension_rays + after.shadow_rays,
                 after.total_ms * 1e-3);
    }
    return frames;
}

/// Lets Embree, where the core has it, alone trace the very same rays, in a pass of its own that leaves the other times
/// as they are.
Status add_trace_limit(CoreSession& session, uint32_t count, Console& console, FrameFigures& frame) {
    if (!session.measure_embree_limit()) return Status::success();
    const auto frames = time_frames(session, count, console, "Embree alone");
    if (!frames.ok()) return frames.status;
    const FrameFigures limit = typical_frame(*frames);
    frame.trace_limit_rays = limit.trace_limit_rays;
    frame.trace_limit_ms = limit.trace_limit_ms;
    return Status::success();
}

}  // namespace

ExitCode run_bench(const Options& options, Console& console) {
    if (!options.output.empty()) {
        if (Status status = check_writable(options.output); !status.ok()) return fail(console, status);
    }
    if (Status status = check_files(options, options.output); !status.ok()) return fail(console, status);
    auto setup = set_up_scene(options, console, output_files(options, {options.output}));
    if (!setup.ok()) return fail(console, setup.status);
    CoreSession session(options, std::move(*setup), console);
    Picture picture(options.width, options.height);
    const auto choice = start_chosen_core(session, options, picture, console);
    if (!choice.ok()) return fail(console, choice.status);

    const uint32_t count = options.spp.front();
    const auto frames = time_frames(session, count, console, choice->core);
    if (!frames.ok()) return fail(console, frames.status);
    const CoreStats stats = session.stats();
    FrameFigures frame = typical_frame(*frames);
    const render_system::EmbreeFigures embree = session.embree_figures();
    if (Status status = add_trace_limit(session, count, console, frame); !status.ok()) return fail(console, status);

    const Json bench = bench_json(options, stats, embree, frame, count);
    const Json extended = stats_json(bench, options, count, choice->reason);
    if (Status status = write_stats(options, extended); !status.ok()) return fail(console, status);
    return deliver(options, console, options.format == Format::json ? json_text(bench) : bench_text(bench));
}

}  // namespace application

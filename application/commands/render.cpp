// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <csignal>

#include "application/commands/command_steps.h"
#include "application/commands/commands.h"
#include "application/file_output.h"
#include "application/sampling/picture_run.h"

namespace application {
namespace {

using render_system::CoreStats;
using render_system::Status;

std::string render_text(const Options& options, const std::string& file, uint32_t samples, const CoreStats& stats) {
    return fmt::format("{}: {}x{}, {} samples per pixel, {} core, {:.2f} s\n", file, options.width, options.height,
                       samples, stats.core, stats.total_ms * 1e-3);
}

}  // namespace

ExitCode run_render(const Options& options, Console& console) {
    const auto start = std::chrono::steady_clock::now();
    const std::string file = options.output.empty() ? default_picture_name(options.scene) : options.output;
    const auto kind = image_kind(file);
    if (!kind.ok()) return fail(console, kind.status);
    if (Status status = check_writable(file); !status.ok()) return fail(console, status);
    if (Status status = check_files(options, file); !status.ok()) return fail(console, status);
    if (Status status = check_sampling(options, file, console); !status.ok()) return fail(console, status);

    if (*kind == ImageKind::exr && changes_colors(options))
        console.note("--exposure and --tone-map act on PNG alone: an EXR holds radiance as it is");

    auto setup = set_up_scene(options, console);
    if (!setup.ok()) return fail(console, setup.status);
    const KeptInterrupt interrupt;
    CoreSession session(options, std::move(*setup), console);
    SampleSums sums(options.width, options.height, options.sampling.noise.has_value());
    session.sum_into(&sums, wanted_samples(options).first);
    Picture picture(options.width, options.height);
    const auto choice = start_chosen_core(session, options, picture, console);
    if (!choice.ok()) return fail(console, choice.status);
    PictureRun run(options, file, session, sums, interrupt, console);
    if (Status status = run.resume(); !status.ok()) return fail(console, status);
    if (Status status = run.take(start); !status.ok()) return fail(console, status);

    const CoreStats stats = session.stats();
    const Json bench = bench_json(options, stats, session.embree_figures(), mean_frame(stats), stats.samples);
    const Json json = stats_json(bench, options, sums.samples, choice->reason);
    if (Status status = run.write(); !status.ok()) return fail(console, status);
    if (Status status = write_stats(options, json); !status.ok()) return fail(console, status);
    const std::string text = render_text(options, file, sums.samples, stats);
    if (!options.output.empty())
        console.note(text.substr(0, text.size() - 1));
    else
        console.result(options.format == Format::json ? json_text(json) : text);
    if (!run.interrupted()) return DONE;
    return interrupt.signal() == SIGINT ? INTERRUPTED : TERMINATED;
}

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "application/cluster/team.h"
#include "application/commands/command_steps.h"
#include "application/commands/commands.h"
#include "application/counted.h"
#include "application/file_output.h"
#include "application/frame_files.h"
#include "application/sampling/checkpoint.h"
#include "application/sampling/picture_run.h"

namespace application {
namespace {

using render_system::CoreStats;
using render_system::Status;

std::string render_text(const Options& options, const std::string& file, uint32_t samples, const CoreStats& stats,
                        double seconds) {
    return fmt::format("{}: {}x{}, {} per pixel, {} core, {:.2f} s\n", file, options.width, options.height,
                       counted(samples, "sample"), stats.core, seconds);
}

/// What stands in the way of a rendering and can be known before the scene is.
Status check_places(const Options& options, const std::string& file, Console& console) {
    const auto kind = image_kind(file);
    if (!kind.ok()) return kind.status;
    if (std::filesystem::path(file).filename().string().find("##") != std::string::npos)
        return Status::invalid(fmt::format(
            "-o {}: ## is the place for the number of a frame; give --frames A:B, or a name without", file));
    if (Status status = check_writable(file); !status.ok()) return status;
    if (Status status = check_files(options, file); !status.ok()) return status;
    if (Status status = check_sampling(options, file, console); !status.ok()) return status;
    if (*kind == ImageKind::exr && changes_colors(options))
        console.note("--exposure and --tone-map act on PNG alone: an EXR holds radiance as it is");
    return Status::success();
}

/// The picture, and the checkpoint beside it where one is kept.
std::vector<OutputFile> outputs_of(const Options& options, const std::string& file) {
    const bool keeps = options.sampling.checkpoint || options.resume;
    return output_files(options, {file, keeps ? checkpoint_of(file) : std::filesystem::path()});
}

/// Takes the samples, on the team where there is one.
Status take_together(PictureRun& run, std::chrono::steady_clock::time_point start) {
    Status status = run.resume();
    if (team()) {
        if (Status same = team()->agree_on(*run.identity()); !same.ok()) return same;
        status = team()->agree(status);
    }
    if (status.ok()) status = run.take(start);
    if (team() && status.ok()) team()->end();
    return status;
}

/// A member of a team that does not lead: nothing is written or said here.
ExitCode help_team(const Options& options, CoreSession& session, Console& console) {
    if (Status status = team()->agree_on(run_identity(options, session)); !status.ok()) return FAILED;
    if (Status status = team()->agree(Status::success()); !status.ok()) return FAILED;
    const Status status = team()->follow(session, keeps_squares(options));
    return status.ok() ? DONE : fail(console, status);
}

/// What one picture alone can be told.
Status check_sequence(const Options& options) {
    const SamplingOptions& sampling = options.sampling;
    if (sampling.range || sampling.time_limit || sampling.noise)
        return Status::invalid("--frames: --samples, --time-limit and --noise are for one picture; leave them out");
    if (sampling.checkpoint && options.filter != FilterMode::temporal)
        return Status::invalid(
            "--checkpoint: frames are files of their own, which --resume keeps; with --frames it is for --filter "
            "temporal");
    return Status::success();
}

}  // namespace

ExitCode run_render(const Options& options, Console& console) {
    const auto start = std::chrono::steady_clock::now();
    if (options.frames) {
        if (Status status = check_sequence(options); !status.ok()) return fail_once(console, status);
        return run_frames(options, console);
    }
    if (options.fps_given)
        return fail_once(console, Status::invalid("--fps: there is no sequence; give --frames, or --time"));
    const std::string file = options.output.empty() ? default_picture_name(options.scene) : options.output;
    const bool leads = !team() || team()->leads();
    if (Status status = agreed(leads ? check_places(options, file, console) : Status::success()); !status.ok())
        return fail_once(console, status);

    auto setup = set_up_scene(options, console, outputs_of(options, file));
    if (Status status = agreed(setup.status); !status.ok()) return fail_once(console, status);
    const KeptInterrupt interrupt;
    CoreSession session(options, std::move(*setup), console);
    SampleSums sums(leads ? options.width : 0, options.height, keeps_squares(options));
    session.stand_still();
    session.sum_into(&sums, wanted_samples(options).first);
    if (team()) session.only_try();
    Picture picture(options.width, options.height);
    const auto choice = start_chosen_core(session, options, picture, console);
    if (Status status = agreed(choice.status); !status.ok()) return fail_once(console, status);
    if (!leads) return help_team(options, session, console);
    PictureRun run(options, file, session, sums, interrupt, console);
    const auto loaded = std::chrono::steady_clock::now();
    if (Status status = take_together(run, start); !status.ok()) return fail(console, status);
    const std::chrono::duration<double> taking = std::chrono::steady_clock::now() - loaded;

    const CoreStats stats = session.stats();
    const Json bench = bench_json(options, stats, session.embree_figures(), mean_frame(stats), stats.samples);
    const Json json = stats_json(bench, options, sums.samples, choice->reason);
    if (Status status = run.write(); !status.ok()) return fail(console, status);
    if (Status status = write_stats(options, json, file); !status.ok()) return fail(console, status);
    // A core in a team knows of its own tiles alone.
    const double seconds = team() ? taking.count() : stats.total_ms * 1e-3;
    const std::string text = render_text(options, file, sums.samples, stats, seconds);
    if (options.format == Format::json)
        console.result(json_text(json));
    else if (options.output.empty())
        console.result(text);
    else
        console.note(text.substr(0, text.size() - 1));
    if (!run.interrupted()) return DONE;
    return exit_code_of_signal(interrupt.signal());
}

}  // namespace application

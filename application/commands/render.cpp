// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "application/commands/command_steps.h"
#include "application/commands/commands.h"
#include "application/file_output.h"

namespace application {
namespace {

using render_system::CoreStats;
using render_system::Status;

std::string render_text(const Options& options, const std::string& file, const CoreStats& stats) {
    return fmt::format("{}: {}x{}, {} samples per pixel, {} core, {:.2f} s\n", file, options.width, options.height,
                       stats.samples, stats.core, stats.total_ms * 1e-3);
}

Status write_picture(const Picture& picture, ImageKind kind, const Options& options, const std::string& file) {
    const auto bytes = encode_picture(picture, kind, options.exposure, options.tone_map);
    return bytes.ok() ? write_file(file, *bytes) : bytes.status;
}

}  // namespace

ExitCode run_render(const Options& options, Console& console) {
    if (options.frames) return run_frames(options, console);
    if (options.resume)
        return fail(console, Status::invalid("--resume: there is no sequence to go on with; give --frames"));
    if (options.fps_given)
        return fail(console, Status::invalid("--fps: there is no sequence; give --frames, or --time"));
    const std::string file = options.output.empty() ? default_picture_name(options.scene) : options.output;
    const auto kind = image_kind(file);
    if (!kind.ok()) return fail(console, kind.status);
    if (Status status = check_writable(file); !status.ok()) return fail(console, status);
    if (Status status = check_files(options, file); !status.ok()) return fail(console, status);

    if (*kind == ImageKind::exr && changes_colors(options))
        console.note("--exposure and --tone-map act on PNG alone: an EXR holds radiance as it is");

    auto setup = set_up_scene(options, console);
    if (!setup.ok()) return fail(console, setup.status);
    CoreSession session(options, std::move(*setup), console);
    Picture picture(options.width, options.height);
    const auto choice = start_chosen_core(session, options, picture, console);
    if (!choice.ok()) return fail(console, choice.status);
    if (Status status = session.render_up_to(options.spp.front()); !status.ok()) return fail(console, status);

    const CoreStats stats = session.stats();
    const Json bench = bench_json(options, stats, session.embree_figures(), mean_frame(stats), stats.samples);
    const Json json = stats_json(bench, options, options.spp.front(), choice->reason);
    if (Status status = write_picture(picture, *kind, options, file); !status.ok()) return fail(console, status);
    if (Status status = write_stats(options, json); !status.ok()) return fail(console, status);
    const std::string text = render_text(options, file, stats);
    if (!options.output.empty()) {
        console.note(text.substr(0, text.size() - 1));
        return DONE;
    }
    console.result(options.format == Format::json ? json_text(json) : text);
    return DONE;
}

}  // namespace application

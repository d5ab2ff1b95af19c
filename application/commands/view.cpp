// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/commands/command_steps.h"
#include "application/commands/commands.h"
#ifdef PORTTOOL_HAS_WINDOW
#include <filesystem>

#include "application/file_output.h"
#include "application/picture.h"
#include "application/scene_setup.h"
#include "application/view/view_window.h"
#endif

namespace application {

using render_system::Status;
using render_system::StatusCode;

#ifdef PORTTOOL_HAS_WINDOW
namespace {

/// Where porttool looks for its map: the folder of the kernels that are being worked on, else the current one.
std::string watched_folder(const Options& options) { return options.kernels.empty() ? "." : options.kernels; }

/// What the keys P, X and K write, as the window has it.
std::vector<std::filesystem::path> saved_files(const Options& options) {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path named = options.output.empty() ? default_picture_name(options.scene) : options.output;
    for (const char* ending : kSavedEndings) files.push_back(std::filesystem::path(named).replace_extension(ending));
    return files;
}

/// A scene that is not there is what is said where there is no display either.
Status check_scene(const Options& options) {
    std::error_code error;
    if (std::filesystem::exists(scene_path(options.scene), error)) return Status::success();
    return Status::error(StatusCode::not_found, options.scene + ": there is no such file; check the path");
}

/// The log is emptied only once there is something to see.
Status check_log(const Options& options) {
    if (options.log.empty()) return Status::success();
    Status status = check_writable(options.log);
    if (!status.ok()) status.message = "--log: " + status.message;
    return status;
}

}  // namespace

ExitCode run_view(const Options& options, Console& console) {
    if (const Status status = check_display(); !status.ok()) {
        const Status scene = check_scene(options);
        return fail(console, scene.ok() ? status : scene);
    }
    if (Status status = check_files(options, options.output); !status.ok()) return fail(console, status);
    if (const auto kind = image_kind(options.output);
        !options.output.empty() && (!kind.ok() || *kind != ImageKind::png))
        return fail(console,
                    Status::invalid("--output " + options.output + ": the key P saves a PNG; end it with .png"));
    ViewLog log;
    if (Status status = check_log(options); !status.ok()) return fail(console, status);
    auto setup = set_up_scene(options, console, output_files(options, saved_files(options)));
    if (!setup.ok()) return fail(console, setup.status);
    if (!options.log.empty())
        if (Status status = log.open(options.log); !status.ok()) return fail(console, status);
    ViewSession session(options, std::move(*setup), log);
    DriftPanel panel(watched_folder(options), log);
    Status status = run_window(options, session, panel, log);
    if (status.ok()) status = log.status();
    return status.ok() ? DONE : fail(console, status);
}
#else
ExitCode run_view(const Options&, Console& console) {
    return fail(console, Status::error(StatusCode::no_device,
                                       "view: this program was built without a window; install libglfw3-dev and "
                                       "libimgui-dev, and build it again"));
}
#endif

}  // namespace application

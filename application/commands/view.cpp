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

/// What the keys P, X and K write.
std::vector<std::filesystem::path> saved_files(const Options& options) {
    std::vector<std::filesystem::path> files;
    for (const char* ending : kSavedEndings) files.push_back(saved_file(options, ending));
    return files;
}

/// A scene that is not there is what is said where there is no display either.
Status check_scene(const Options& options) {
    std::error_code error;
    if (std::filesystem::exists(scene_path(options.scene), error)) return Status::success();
    return Status::error(StatusCode::not_found, options.scene + ": there is no such file; check the path");
}

/// What an option names to be written, if it does. The log is emptied only once there is something to see.
Status check_place(const char* option, const std::string& file) {
    if (file.empty()) return Status::success();
    Status status = check_writable(file);
    if (!status.ok()) status.message = std::string(option) + ": " + status.message;
    return status;
}

/// That what --kernels names is no folder of something else: the source core, which reads it, may start much later.
Status check_kernels(const Options& options) {
    if (options.kernels.empty()) return Status::success();
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(options.kernels, error))
        if (entry.path().extension() == ".comp") return Status::success();
    return Status::error(StatusCode::not_found, "--kernels: there are no kernels (*.comp) in " + options.kernels +
                                                    "; give a copy of source_core/kernels, or leave it out");
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
    if (Status status = check_kernels(options); !status.ok()) return fail(console, status);
    if (Status status = check_place("--log", options.log); !status.ok()) return fail(console, status);
    if (Status status = check_place("--output", options.output); !status.ok()) return fail(console, status);
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

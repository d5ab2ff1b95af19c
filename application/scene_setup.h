// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "application/console.h"
#include "application/options.h"
#include "application/output_files.h"
#include "render_system/host_scene.h"
#include "render_system/status.h"

namespace application {

/// The file that `scene` means: itself where it exists and is no folder, else the built-in scene of that name, else
/// itself again (so that the loader says what is wrong). Built-in scenes lie in the data folder of an installed copy
/// (`<program>/../share/porttool/scenes`), or in the source tree.
std::filesystem::path scene_path(const std::string& scene);

/// The default picture of a scene: its stem with .png, in the current folder.
std::string default_picture_name(const std::string& scene);

/// A scene with camera and sky as the options ask for them.
struct SceneSetup {
    render_system::HostScene scene;
    render_system::Camera camera;
    std::optional<uint32_t> followed;  ///< the scene's camera that `camera` is, where nothing else was asked for
};

/// The scene's camera `followed` as it stands now, with lens and field of view as the options have them. Fails with
/// invalid_argument where it is out of bounds.
render_system::Result<render_system::Camera> followed_camera(const Options& options,
                                                             const render_system::HostScene& scene, uint32_t followed);

/// Loads the scene as it is at `--time`, adds what the camera file brings, chooses camera and sky. Says on the console
/// what was warned of and what was chosen in place of what is missing.
/// Fails as check_outputs does where one of `outputs` is a file that was read for it, or a kernel that a core will
/// read.
render_system::Result<SceneSetup> set_up_scene(const Options& options, Console& console,
                                               const std::vector<OutputFile>& outputs = {});

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>

#include "application/options.h"
#include "application/view/drift_panel.h"
#include "application/view/view_log.h"
#include "application/view/view_session.h"
#include "render_system/status.h"

namespace application {

/// What follows the picture's stem in the files that the keys P, X and K write.
constexpr std::array<const char*, 3> kSavedEndings = {".png", ".exr", ".camera.json"};

/// The file that such a key writes: beside the picture that -o names. Without one the scene's name is not enough, for
/// `duck.png` is often a texture of `duck.gltf`.
std::filesystem::path saved_file(const Options& options, const char* ending);

/// Whether a window can be opened here: there is a display. Fails with no_device; the message says what to do.
render_system::Status check_display();

/// Opens the window and runs it until it is closed. Fails with no_device where there is no OpenGL 3.
render_system::Status run_window(const Options& options, ViewSession& session, DriftPanel& panel, ViewLog& log);

}  // namespace application

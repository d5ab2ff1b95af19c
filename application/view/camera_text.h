// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "render_system/camera.h"
#include "render_system/status.h"

namespace application {

/// A camera as a file that `--camera` takes. What the camera file `like` has beside (sky, lights) stays; "" for none.
/// Lens and focus are options, not of the file. Fails with invalid_argument for a camera whose rays are parallel, for
/// which the file has no word, and with unreadable where `like` is no JSON any more.
render_system::Result<std::string> camera_text(const render_system::Camera& camera, const std::string& like);

}  // namespace application

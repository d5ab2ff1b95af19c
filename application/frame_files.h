// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "application/options.h"
#include "render_system/status.h"

// The files of a sequence: their names, and what each says it was made with.

namespace application {

/// The name of frame `number`: the last run of # in the file's own name becomes the number, with zeros up to the length
/// of the run. Fails with invalid_argument where there is no #.
render_system::Result<std::string> frame_file(const std::string& pattern, uint32_t number);

/// The seconds of a frame.
double frame_time(const Options& options, uint32_t number);

/// One line of all that decides what the picture of a sequence shows, but for its time: options, the contents of the
/// files that they name, and where the scene has no camera the first frame, which the view frames.
std::string sequence_text(const Options& options, bool framed);

/// With the time of a frame.
std::string frame_text(const std::string& sequence, double seconds);

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "application/options.h"
#include "application/picture.h"
#include "render_system/host_scene.h"
#include "render_system/status.h"

// The files of a sequence: their names, and what each says it was made with.

namespace application {

/// The name of frame `number`: the last run of # in the file's own name becomes the number, with zeros up to the length
/// of the run. Fails with invalid_argument where there is no #.
render_system::Result<std::string> frame_file(const std::string& pattern, uint32_t number);

/// Whether a file of that name is a frame of that sequence, whose pattern has a #.
bool is_frame_name(const std::string& pattern, const FrameRange& frames, const std::string& name);

/// The files of that sequence that are there already.
std::vector<std::filesystem::path> frames_there(const std::string& pattern, const FrameRange& frames);

/// The seconds of a frame.
double frame_time(const Options& options, uint32_t number);

/// One line of what decides what the pictures of a sequence show and no frame changes: options, textures and sky.
std::string sequence_text(const Options& options, const render_system::HostScene& scene);

/// With the scene as it stands in a frame, the view of it and its time.
std::string frame_text(const std::string& sequence, const render_system::HostScene& scene,
                       const render_system::ViewPyramid& view, double seconds);

/// The bytes of a frame's file, which says `text` and a checksum of its pixels.
render_system::Result<std::string> encode_frame(const Picture& picture, ImageKind kind, const Options& options,
                                                const std::string& text);

/// Whether the file is there, says `text` and holds every pixel as it was written: none that was cut off or altered.
bool holds_frame(const std::string& file, ImageKind kind, const std::string& text);

}  // namespace application

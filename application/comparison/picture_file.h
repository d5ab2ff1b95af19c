// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "application/comparison/figures.h"
#include "render_system/status.h"

namespace application {

using PixelPlace = std::array<uint32_t, 2>;  ///< x, y

/// An image file of any program, as `compare` takes it.
struct PictureFile {
    std::string name;
    BothForms forms;  ///< a PNG's levels as they are in the file, NaN being 0; grey three times over
    int channels = 0;
    std::vector<PixelPlace> nan_pixels;
};

/// Fails with not_found or unreadable; the message names the file and the remedy.
render_system::Result<PictureFile> read_picture_file(const std::string& name);

/// Whether two files can be compared: same size, same number of channels.
render_system::Status check_alike(const PictureFile& a, const PictureFile& b);

/// Pixels that are NaN as a note on stderr has them; empty if there are none.
std::string nan_note(const std::string& name, const std::vector<PixelPlace>& places);

/// The first of them, for JSON.
Json nan_places_json(const std::vector<PixelPlace>& places);

/// Makes these pixels magenta.
void mark_pixels(Channels<uint8_t>& image, const std::vector<PixelPlace>& places);

}  // namespace application

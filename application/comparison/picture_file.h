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

/// Pixels of a picture of which no mean can be taken.
struct OddPixels {
    std::vector<PixelPlace> nan;       ///< with a channel that is NaN
    std::vector<PixelPlace> infinite;  ///< of the others, those with a channel that is infinite

    void add(const OddPixels& more);
};

OddPixels odd_pixels_of(const Channels<float>& image);

/// An image file of any program, as `compare` takes it.
struct PictureFile {
    std::string name;
    BothForms forms;  ///< a PNG's levels as they are in the file, NaN being 0; grey three times over
    int channels = 0;
    OddPixels odd;
};

/// Fails with not_found or unreadable; the message names the file and the remedy.
render_system::Result<PictureFile> read_picture_file(const std::string& name);

/// Whether two files can be compared: same size, same number of channels.
render_system::Status check_alike(const PictureFile& a, const PictureFile& b);

/// Those pixels as notes for stderr, one of each kind that there is.
std::vector<std::string> notes_of(const std::string& name, const OddPixels& odd);

/// Adds how many there are and the first places, to JSON under names that end in `_` and `side`.
void add_odd_pixels(Json& json, const std::string& side, const OddPixels& odd);

/// Makes these pixels magenta.
void mark_pixels(Channels<uint8_t>& image, const OddPixels& odd);

}  // namespace application

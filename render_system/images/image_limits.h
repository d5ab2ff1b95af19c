// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "render_system/loader/load_error.h"

namespace render_system {

/// 16384 x 16384; more than that is a broken header rather than a texture.
inline constexpr uint64_t kMostTexels = uint64_t{1} << 28;
/// No format here packs much tighter than 1000 : 1, so a short file cannot hold a large picture.
inline constexpr uint64_t kMostCompression = 4096;

/// What to do about a picture that is not whole.
inline constexpr const char* kSaveAgain = "; copy or save it again";

/// Throws LoadError for a picture without pixels, of too many, or of more than `file_size` bytes can hold.
inline void check_image_size(uint64_t width, uint64_t height, uint64_t channels, uint64_t file_size) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1 || channels < 1) fail_at("", "has no pixels (" + size + ")" + kSaveAgain);
    if (width > kMostTexels || height > kMostTexels || width * height > kMostTexels)
        fail_at("", "is too large (" + size + "); 16384x16384 is the most");
    constexpr uint64_t kMostChannels = 4;  // of the largest picture
    if (channels > kMostChannels * kMostTexels / (width * height))
        fail_at("", "is too large (" + size + " with " + std::to_string(channels) +
                        " channels); 16384x16384 with 4 is the most");
    if (width * height / kMostCompression > file_size)
        fail_at("", "is far too short for its " + size + " pixels; it is cut off, copy or save it again");
}

}  // namespace render_system

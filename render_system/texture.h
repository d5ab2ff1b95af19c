// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render_system/host_scene.h"

namespace render_system {

/// A picture as it came from a file: rows top to bottom, RGBA, one of the three arrays filled.
struct Image {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> bytes;       ///< rgba8 as stored in the file, red in the lowest byte
    std::vector<glm::u16vec4> shorts;  ///< 16-bit files: as stored, 65535 is 1
    std::vector<glm::vec4> floats;     ///< float files: linear radiance
    bool is_hdr = false;               ///< `floats` is linear light without an upper limit
    int channels = 0;                  ///< of the file

    size_t texels() const { return size_t{width} * height; }
    /// Texel i of whichever array is filled, as stored: 0 to 1 but for float files.
    glm::vec4 texel(size_t i) const;
};

/// What a texture's numbers mean, which decides how they are stored and filtered.
enum class TextureRole { color, data };

/// Builds a texture with its mip chain. Colour is stored as sRGB and filtered in linear light, data is linear; HDR
/// images become rgb9e5. Level 0 of an image of 8 or 16 bits holds the file's numbers as they are. Each level is the
/// exact area average (box) of the one above, taken before that one is rounded; odd sizes share texels by fractions.
/// `with_mips` false leaves level 0 alone. Wrap modes and filter are for the caller to set.
HostTexture build_texture(Image image, TextureRole role, bool with_mips = true);

/// The mean of level 0 in linear light.
glm::vec3 mean_color(const HostTexture& texture);

/// What stands in for an image that cannot be read: 8x8 squares of magenta and black.
Image placeholder_image();

}  // namespace render_system

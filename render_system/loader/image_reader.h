// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "render_system/texture.h"

namespace render_system {

/// Decodes a PNG, JPEG, WebP, BMP, TGA, Radiance HDR or OpenEXR image that lies in memory, told apart by content
/// (`name` decides for TGA, which has no mark of its own). Grey becomes RGB, missing alpha 1; colours are never
/// multiplied with alpha. 8-bit and 16-bit images keep their numbers. Throws LoadError; the message says what is wrong,
/// not where the image came from.
Image read_image(std::span<const std::byte> bytes, const std::string& name);

}  // namespace render_system

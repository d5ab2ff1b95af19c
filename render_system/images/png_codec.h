// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "render_system/images/image_library.h"

namespace render_system {

/// True for bytes that begin as a PNG does.
bool is_png(std::span<const std::byte> bytes);

/// As read_image (loader/image_reader.h), for a PNG.
Image decode_png(std::span<const std::byte> bytes);

/// The bytes of a PNG: 8 bits of sRGB for each of R, G and B, its notes as texts.
Result<std::string> encode_png(const ImageToWrite& image);

}  // namespace render_system

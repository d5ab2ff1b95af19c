// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "render_system/texture.h"

namespace render_system {

/// As read_image (loader/image_reader.h), but for PNG (png_codec.h).
Image decode_image(std::span<const std::byte> bytes, const std::string& name);

}  // namespace render_system

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "render_system/images/image_library.h"

namespace render_system {

/// The bytes of an OpenEXR file of scan lines, compressed by zip, its notes as attributes.
Result<std::string> encode_exr(const ImageToWrite& image);

}  // namespace render_system

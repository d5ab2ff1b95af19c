// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "application/picture.h"

namespace application {

/// What the window shows of the two cores.
enum class Show : uint8_t { One, Split, Difference };

/// How two pictures become one.
struct Composition {
    Show show = Show::One;
    float split = 0.5f;  ///< left of this share of the width stands the first picture, right of it the second
    int gain = 16;       ///< what a difference is multiplied by
};

/// The picture in another size, by its nearest pixels.
Channels<uint8_t> resized(const Channels<uint8_t>& picture, uint32_t width, uint32_t height);

/// Both pictures as one, in the size of the larger; the second one is not looked at for Show::One.
Channels<uint8_t> composed(const Channels<uint8_t>& first, const Channels<uint8_t>& second, const Composition& how);

/// What is said of a picture that is saved at another size than was asked for; "" at that size.
std::string coarse_note(uint32_t width, uint32_t height, uint32_t whole_width, uint32_t whole_height);

}  // namespace application

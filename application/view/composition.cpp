// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/composition.h"

#include <fmt/format.h>

#include <algorithm>

namespace application {

Channels<uint8_t> resized(const Channels<uint8_t>& picture, uint32_t width, uint32_t height) {
    if (picture.width == width && picture.height == height) return picture;
    Channels<uint8_t> out{width, height, std::vector<uint8_t>(size_t{3} * width * height)};
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            const size_t from = size_t{3} * ((uint64_t{y} * picture.height / height) * picture.width +
                                             uint64_t{x} * picture.width / width);
            std::copy_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(from), 3,
                        out.rgb.begin() + static_cast<std::ptrdiff_t>(size_t{3} * (size_t{y} * width + x)));
        }
    return out;
}

Channels<uint8_t> composed(const Channels<uint8_t>& first, const Channels<uint8_t>& second, const Composition& how) {
    if (how.show == Show::One) return first;
    const uint32_t width = std::max(first.width, second.width), height = std::max(first.height, second.height);
    Channels<uint8_t> left = resized(first, width, height);
    const Channels<uint8_t> right = resized(second, width, height);
    if (how.show == Show::Difference) return difference_image(left, right, how.gain);
    const auto middle = static_cast<uint32_t>(std::clamp(how.split, 0.0f, 1.0f) * static_cast<float>(width));
    for (uint32_t y = 0; y < height; ++y) {
        const auto row = static_cast<std::ptrdiff_t>(size_t{3} * y * width), cut = row + std::ptrdiff_t{3} * middle;
        std::copy(right.rgb.begin() + cut, right.rgb.begin() + row + std::ptrdiff_t{3} * width, left.rgb.begin() + cut);
    }
    return left;
}

std::string coarse_note(uint32_t width, uint32_t height, uint32_t whole_width, uint32_t whole_height) {
    if (width == whole_width && height == whole_height) return "";
    return fmt::format(", a coarse first picture of {}x{}; save again once it is drawn at {}x{}", width, height,
                       whole_width, whole_height);
}

}  // namespace application

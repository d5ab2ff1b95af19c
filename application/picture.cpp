// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace application {

uint8_t srgb_level(float linear) {
    if (!(linear > 0.0f)) return 0;
    const double value = std::min(static_cast<double>(linear), 1.0);
    const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
    return static_cast<uint8_t>(std::lround(255.0 * encoded));
}

Channels<uint8_t> srgb_levels(const Picture& picture) { return srgb_levels(picture, 0.0f, ToneMap::none); }

Channels<uint8_t> srgb_levels(const Picture& picture, float stops, ToneMap curve) {
    Channels<uint8_t> image{picture.width, picture.height, {}};
    image.rgb.reserve(picture.pixels.size() * 3);
    const float exposure = std::exp2(stops);  // of 0 stops exactly 1
    for (const glm::vec4& pixel : picture.pixels) {
        const glm::vec3 color = tone_mapped(glm::vec3(pixel), exposure, curve);
        for (int channel = 0; channel < 3; ++channel) image.rgb.push_back(srgb_level(color[channel]));
    }
    return image;
}

Channels<float> linear_values(const Picture& picture) {
    Channels<float> image{picture.width, picture.height, {}};
    image.rgb.reserve(picture.pixels.size() * 3);
    for (const glm::vec4& pixel : picture.pixels) {
        for (int channel = 0; channel < 3; ++channel) image.rgb.push_back(pixel[channel]);
    }
    return image;
}

Channels<uint8_t> difference_image(const Channels<uint8_t>& a, const Channels<uint8_t>& b, int gain) {
    Channels<uint8_t> image{a.width, a.height, std::vector<uint8_t>(a.rgb.size())};
    for (size_t i = 0; i < a.rgb.size(); ++i) {
        image.rgb[i] = static_cast<uint8_t>(std::min(255, std::abs(int{a.rgb[i]} - int{b.rgb[i]}) * gain));
    }
    return image;
}

}  // namespace application

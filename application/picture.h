// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "application/tone_map.h"
#include "metrics/image/image_view.h"
#include "render_system/status.h"

namespace application {

/// What a core renders into: linear radiance, row-major from the top left.
struct Picture {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<glm::vec4> pixels;

    Picture(uint32_t width_in, uint32_t height_in)
        : width(width_in), height(height_in), pixels(size_t{width_in} * height_in) {}
};

/// The three colour channels of a picture, as files and metrics take them.
template <class Value>
struct Channels {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<Value> rgb;

    metrics::ImageView<Value> view() const { return {width, height, rgb}; }
};

/// The level (0 to 255) of a linear value: clamped to 0..1, the sRGB curve (IEC 61966-2-1), rounded to nearest.
/// NaN is 0.
uint8_t srgb_level(float linear);

/// What a PNG of the picture holds.
Channels<uint8_t> srgb_levels(const Picture& picture);

/// The same picture with that exposure (stops) and tone map.
Channels<uint8_t> srgb_levels(const Picture& picture, float stops, ToneMap curve);

/// The picture without alpha.
Channels<float> linear_values(const Picture& picture);

/// The levels' absolute difference times `gain`, clamped: 0 is black where both agree.
Channels<uint8_t> difference_image(const Channels<uint8_t>& a, const Channels<uint8_t>& b, int gain);

/// Image formats by the file name's end.
enum class ImageKind { png, exr };

/// The kind of `file_name`; fails with invalid_argument on any end but .png and .exr, in either case.
render_system::Result<ImageKind> image_kind(const std::string& file_name);

/// What a file says of its picture beside the pixels; what is 0 or empty is left out.
struct PictureNotes {
    uint32_t samples = 0;     ///< of each pixel: the attribute `samples` of an EXR, the text `samples` of a PNG
    std::string ranges = {};  ///< which samples these are, as range_text has them: `sampleRanges` of an EXR and, where
                              ///< they are not the first ones, of a PNG
    std::string run = {};     ///< what decides their bits, as RunIdentity::text has it: `pathtracerRun` of an EXR
    std::string made_with = {};  ///< of a picture of a sequence: the text kMadeWith
};

/// The name of the text that a picture of a sequence carries: what it was made with.
constexpr const char* kMadeWith = "pathtracer";

/// That text of a file that is there; empty where there is none, or no picture.
std::string made_with(const std::string& file_name);

/// The bytes of a file: PNG of 8 bits a channel, or EXR of 32-bit floats. The same values give the same bytes: no
/// date, no host name.
render_system::Result<std::string> encode_png(const Channels<uint8_t>& image, const PictureNotes& notes = {});
render_system::Result<std::string> encode_exr(const Channels<float>& image, const PictureNotes& notes = {});

/// The bytes of the picture as a file of that kind; exposure (stops) and tone map act on PNG alone.
render_system::Result<std::string> encode_picture(const Picture& picture, ImageKind kind, float stops, ToneMap curve,
                                                  const PictureNotes& notes = {});

}  // namespace application

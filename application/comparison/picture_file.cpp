// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/comparison/picture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render_system/scene_loader.h"

namespace application {

using render_system::Image;
using render_system::Result;
using render_system::Status;

namespace {

constexpr size_t kPlacesListed = 16;

/// The light of an encoded value (IEC 61966-2-1).
float linear_of_srgb(float encoded) {
    const double value = encoded;
    return static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

uint8_t nearest_level(float encoded) {
    return static_cast<uint8_t>(std::lround(255.0 * std::clamp(encoded, 0.0f, 1.0f)));
}

BothForms forms_of(const Image& image) {
    BothForms forms{{image.width, image.height, {}}, {image.width, image.height, {}}};
    const size_t values = image.texels() * metrics::CHANNELS;
    forms.levels.rgb.reserve(values);
    forms.linear.rgb.reserve(values);
    const bool encoded = image.floats.empty();
    for (size_t i = 0; i < image.texels(); ++i) {
        const glm::vec4 texel = image.texel(i);
        for (int channel = 0; channel < 3; ++channel) {
            const float value = texel[channel];
            forms.levels.rgb.push_back(encoded ? nearest_level(value) : srgb_level(value));
            forms.linear.rgb.push_back(encoded ? linear_of_srgb(value) : value);
        }
    }
    return forms;
}

Json places_json(const std::vector<PixelPlace>& places) {
    Json list = Json::array();
    for (size_t i = 0; i < std::min(places.size(), kPlacesListed); ++i) list.push_back(places[i]);
    return list;
}

std::string note_of(const std::string& name, const std::vector<PixelPlace>& places, const char* what,
                    const char* levels) {
    return fmt::format("{}: {} pixel{} {}, the first at {},{}; {}, RMSE linear leaves them out", name, places.size(),
                       places.size() == 1 ? " is" : "s are", what, places[0][0], places[0][1], levels);
}

}  // namespace

void OddPixels::add(const OddPixels& more) {
    nan.insert(nan.end(), more.nan.begin(), more.nan.end());
    infinite.insert(infinite.end(), more.infinite.begin(), more.infinite.end());
}

OddPixels odd_pixels_of(const Channels<float>& image) {
    const auto any = [&](size_t first, bool (*is_so)(float)) {
        return is_so(image.rgb[first]) || is_so(image.rgb[first + 1]) || is_so(image.rgb[first + 2]);
    };
    OddPixels odd;
    for (size_t i = 0; i < image.rgb.size(); i += metrics::CHANNELS) {
        const bool is_nan = any(i, [](float value) { return std::isnan(value); });
        if (!is_nan && !any(i, [](float value) { return std::isinf(value); })) continue;
        const auto pixel = static_cast<uint32_t>(i / metrics::CHANNELS);
        (is_nan ? odd.nan : odd.infinite).push_back({pixel % image.width, pixel / image.width});
    }
    return odd;
}

Result<PictureFile> read_picture_file(const std::string& name) {
    const auto image = render_system::load_image(name);
    if (!image.ok()) return image.status;
    PictureFile file{name, forms_of(*image), image->channels, {}};
    file.odd = odd_pixels_of(file.forms.linear);
    return file;
}

Status check_alike(const PictureFile& a, const PictureFile& b) {
    const auto size = [](const PictureFile& file) {
        return fmt::format("{}x{}", file.forms.levels.width, file.forms.levels.height);
    };
    if (size(a) != size(b)) {
        return Status::invalid(
            fmt::format("{} is {} and {} is {}; only pictures of one size can be compared, render one anew", a.name,
                        size(a), b.name, size(b)));
    }
    if (a.channels == b.channels) return Status::success();
    return Status::invalid(fmt::format("{} has channels: {}, {} has {}; write both with the same channels", a.name,
                                       a.channels, b.name, b.channels));
}

std::vector<std::string> notes_of(const std::string& name, const OddPixels& odd) {
    std::vector<std::string> notes;
    if (!odd.nan.empty()) notes.push_back(note_of(name, odd.nan, "NaN", "levels take them as 0"));
    if (!odd.infinite.empty())
        notes.push_back(note_of(name, odd.infinite, "infinite", "levels take them as the brightest or as 0"));
    return notes;
}

void add_odd_pixels(Json& json, const std::string& side, const OddPixels& odd) {
    json["nan_pixels_" + side] = odd.nan.size();
    json["nan_places_" + side] = places_json(odd.nan);
    json["infinite_pixels_" + side] = odd.infinite.size();
    json["infinite_places_" + side] = places_json(odd.infinite);
}

void mark_pixels(Channels<uint8_t>& image, const OddPixels& odd) {
    for (const auto* places : {&odd.nan, &odd.infinite}) {
        for (const PixelPlace& place : *places) {
            uint8_t* rgb = &image.rgb[(size_t{place[1]} * image.width + place[0]) * metrics::CHANNELS];
            rgb[0] = rgb[2] = 255;
            rgb[1] = 0;
        }
    }
}

}  // namespace application

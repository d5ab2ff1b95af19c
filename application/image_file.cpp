// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Pictures as files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "application/picture.h"
#include "render_system/images/image_library.h"

namespace application {
namespace {

using render_system::ImageToWrite;
using render_system::Result;
using render_system::SampleType;
using render_system::Status;
using render_system::StatusCode;

/// The bytes of a picture of red, green and blue.
Result<std::string> encode(ImageToWrite image, const PictureNotes& notes, const void* values) {
    if (!notes.made_with.empty()) image.notes.insert(image.notes.begin(), {kMadeWith, notes.made_with});
    image.values = values;
    auto bytes = render_system::encode_image(image);
    if (!bytes.ok())
        bytes.status.message = fmt::format("cannot encode the picture as {}: {}", image.format, bytes.status.message);
    return bytes;
}

}  // namespace

Result<ImageKind> image_kind(const std::string& file_name) {
    std::string extension = std::filesystem::path(file_name).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".png") return ImageKind::png;
    if (extension == ".exr") return ImageKind::exr;
    return Status::invalid(
        fmt::format("cannot write {}: its name ends in neither .png nor .exr; give one that does", file_name));
}

std::string made_with(const std::string& file_name) {
    const auto library = render_system::image_library();
    const auto file = library.ok() ? (*library)->open(file_name) : library.status;
    return file.ok() ? (*file)->text(kMadeWith) : std::string();
}

Result<std::string> encode_png(const Channels<uint8_t>& image, const PictureNotes& notes) {
    ImageToWrite out{"png", image.width, image.height, {}, {SampleType::u8}};
    if (notes.samples > 0) out.notes.emplace_back("samples", std::to_string(notes.samples));
    const bool are_first = notes.ranges == fmt::format("0:{}", notes.samples);
    if (!notes.ranges.empty() && !are_first) out.notes.emplace_back("sampleRanges", notes.ranges);
    return encode(std::move(out), notes, image.rgb.data());
}

Result<std::string> encode_exr(const Channels<float>& image, const PictureNotes& notes) {
    ImageToWrite out{"exr", image.width, image.height, {}, {SampleType::f32}};
    if (notes.samples > 0) out.notes.emplace_back("samples", static_cast<int>(notes.samples));
    if (!notes.ranges.empty()) out.notes.emplace_back("sampleRanges", notes.ranges);
    if (!notes.run.empty()) out.notes.emplace_back("pathtracerRun", notes.run);
    return encode(std::move(out), notes, image.rgb.data());
}

Result<std::string> encode_picture(const Picture& picture, ImageKind kind, float stops, ToneMap curve,
                                   const PictureNotes& notes) {
    return kind == ImageKind::png ? encode_png(srgb_levels(picture, stops, curve), notes)
                                  : encode_exr(linear_values(picture), notes);
}

}  // namespace application

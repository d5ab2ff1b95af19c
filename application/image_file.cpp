// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Pictures as files. OpenImageIO is known here and where files of sums are (sampling/sum_file.cpp).
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "application/picture.h"

namespace application {
namespace {

using render_system::Result;
using render_system::Status;
using render_system::StatusCode;

/// Encodes into memory, so that the file itself is written in one place for all kinds. `extension` chooses the format,
/// the format of `spec` is that of the values.
Result<std::string> encode(const std::string& extension, const OIIO::ImageSpec& spec, const void* values) {
    const std::string name = "picture." + extension;
    OIIO::Filesystem::IOVecOutput memory;
    auto output = OIIO::ImageOutput::create(name, &memory);
    const bool written =
        output && output->open(name, spec) && output->write_image(spec.format, values) && output->close();
    if (!written) {
        const std::string reason = output ? output->geterror() : OIIO::geterror();
        return Status::error(StatusCode::internal,
                             fmt::format("cannot encode the picture as {}: {}", extension, reason));
    }
    const std::vector<unsigned char>& bytes = memory.buffer();
    return std::string(bytes.begin(), bytes.end());
}

OIIO::ImageSpec plain_spec(uint32_t width, uint32_t height, OIIO::TypeDesc::BASETYPE type,
                           const std::string& made_with) {
    OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 3, type);
    // Left alone, OpenImageIO adds the time of day, and the same pixels would give other bytes. An empty one is not
    // written at all.
    spec.attribute("DateTime", "");
    if (!made_with.empty()) spec.attribute(kMadeWith, made_with);
    return spec;
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
    const auto input = OIIO::ImageInput::open(file_name);
    if (!input) OIIO::geterror();  // else it is kept, and told at the end of the program
    return input ? std::string(input->spec().get_string_attribute(kMadeWith)) : std::string();
}

Result<std::string> encode_png(const Channels<uint8_t>& image, const PictureNotes& notes) {
    OIIO::ImageSpec spec = plain_spec(image.width, image.height, OIIO::TypeDesc::UINT8, notes.made_with);
    spec.attribute("oiio:ColorSpace", "sRGB");
    if (notes.samples > 0) spec.attribute("samples", std::to_string(notes.samples));
    return encode("png", spec, image.rgb.data());
}

Result<std::string> encode_exr(const Channels<float>& image, const PictureNotes& notes) {
    OIIO::ImageSpec spec = plain_spec(image.width, image.height, OIIO::TypeDesc::FLOAT, notes.made_with);
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("compression", "zip");
    if (notes.samples > 0) spec.attribute("samples", static_cast<int>(notes.samples));
    if (!notes.ranges.empty()) spec.attribute("sampleRanges", notes.ranges);
    if (!notes.run.empty()) spec.attribute("pathtracerRun", notes.run);
    return encode("exr", spec, image.rgb.data());
}

Result<std::string> encode_picture(const Picture& picture, ImageKind kind, float stops, ToneMap curve,
                                   const PictureNotes& notes) {
    return kind == ImageKind::png ? encode_png(srgb_levels(picture, stops, curve), notes)
                                  : encode_exr(linear_values(picture), notes);
}

}  // namespace application

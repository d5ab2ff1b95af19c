// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "render_system/status.h"
#include "render_system/texture.h"

// Pictures as files. OpenImageIO brings 250 libraries and a third of a second: it lies in a module of its own,
// pathtracer-images.so, which is loaded when a picture is read that is no PNG (decision 29).

namespace render_system {

enum class SampleType : uint8_t { u8, u32, f32 };

/// A picture to be written.
struct ImageToWrite {
    std::string format;  ///< "exr"; or "png", of 8 bits of sRGB in R, G and B
    uint32_t width = 0, height = 0;
    std::vector<std::string> channels;                                          ///< their names; none: R, G and B
    std::vector<SampleType> types;                                              ///< one a channel, or one for all
    std::vector<std::pair<std::string, std::variant<std::string, int>>> notes;  ///< attributes, in this order
    const void* values = nullptr;  ///< rows top to bottom, the channels of a pixel together, each in its type
};

/// A file that was opened to be read.
class ImageFile {
public:
    virtual ~ImageFile() = default;

    std::string format;  ///< "openexr", "png", ...
    int width = 0, height = 0;
    bool is_flat = true;  ///< neither with depth nor deep
    std::vector<std::string> channels;

    /// A text among its attributes; empty where there is none.
    virtual std::string text(const std::string& name) const = 0;
    virtual int number(const std::string& name) const = 0;
    /// Reads channels [first, end) of all pixels as `type`. What went wrong, or empty.
    virtual std::string read(int first, int end, SampleType type, void* values) = 0;
};

/// What reads pictures by OpenImageIO.
class ImageLibrary {
public:
    virtual ~ImageLibrary() = default;

    /// As read_image (loader/image_reader.h), but for PNG.
    virtual Image decode(std::span<const std::byte> bytes, const std::string& name) = 0;
    /// Fails with unreadable and what the library says.
    virtual Result<std::unique_ptr<ImageFile>> open(const std::string& file) = 0;
};

/// Loads the module where that was not done yet. Fails with not_found where it is missing, of another version, or does
/// not load.
Result<ImageLibrary*> image_library();

/// The bytes of the file; the status says what the library says.
Result<std::string> encode_image(const ImageToWrite& image);

/// What program and module agree on; raised with each change of the classes above.
constexpr int kImageLibraryVersion = 2;

}  // namespace render_system

/// What the module exports: the library, or null for another version.
extern "C" [[gnu::visibility("default")]] render_system::ImageLibrary* pathtracer_image_library(int version);

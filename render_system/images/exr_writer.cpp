// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/images/exr_writer.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

namespace render_system {

namespace {

/// A file in memory.
class MemoryFile final : public Imf::OStream {
public:
    MemoryFile() : Imf::OStream("memory") {}

    std::string bytes;

    void write(const char text[], int size) override {
        bytes.replace(place_, static_cast<size_t>(size), text, static_cast<size_t>(size));
        place_ += static_cast<size_t>(size);
    }
    uint64_t tellp() override { return place_; }
    void seekp(uint64_t place) override { place_ = static_cast<size_t>(place); }

private:
    size_t place_ = 0;
};

Imf::Header header_of(const ImageToWrite& image) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [name, value] : image.notes) {
        if (const auto* number = std::get_if<int>(&value)) header.insert(name, Imf::IntAttribute(*number));
        if (const auto* text = std::get_if<std::string>(&value)) header.insert(name, Imf::StringAttribute(*text));
    }
    return header;
}

void write_pixels(const ImageToWrite& image, MemoryFile& file) {
    constexpr size_t kValue = 4;  // bytes: a float or a whole number
    const std::vector<std::string> names =
        image.channels.empty() ? std::vector<std::string>{"R", "G", "B"} : image.channels;
    const size_t pixel = kValue * names.size(), row = pixel * image.width;
    Imf::Header header = header_of(image);
    Imf::FrameBuffer values;
    for (size_t i = 0; i < names.size(); ++i) {
        const SampleType type = image.types.size() > 1 ? image.types[i] : image.types.front();
        const Imf::PixelType stored = type == SampleType::f32 ? Imf::FLOAT : Imf::UINT;
        header.channels().insert(names[i], Imf::Channel(stored));
        char* first = const_cast<char*>(static_cast<const char*>(image.values)) + kValue * i;  // which it only reads
        values.insert(names[i], Imf::Slice(stored, first, pixel, row));
    }
    Imf::OutputFile output(file, header);
    output.setFrameBuffer(values);
    output.writePixels(static_cast<int>(image.height));
}

}  // namespace

Result<std::string> encode_exr(const ImageToWrite& image) {
    constexpr uint64_t kLarge = 1 << 18;  // pixels: from there on threads are worth their start
    if (uint64_t{image.width} * image.height >= kLarge)
        Imf::setGlobalThreadCount(static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 16u)));
    MemoryFile file;
    try {
        write_pixels(image, file);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        return Status::error(StatusCode::internal, error.what());
    }
    return std::move(file.bytes);
}

}  // namespace render_system

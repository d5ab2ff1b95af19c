// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/images/image_decoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "render_system/images/image_limits.h"
#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

using Bytes = std::span<const std::byte>;

[[noreturn]] void fail(const std::string& what) { fail_at("", what); }

bool starts_with(Bytes bytes, std::string_view mark) {
    return bytes.size() >= mark.size() && std::memcmp(bytes.data(), mark.data(), mark.size()) == 0;
}

// OpenImageIO's name for the reader to use.
std::string format_name(Bytes bytes, const std::string& name) {
    if (starts_with(bytes, "\xFF\xD8\xFF")) return "jpeg";
    if (starts_with(bytes, "\x76\x2F\x31\x01")) return "openexr";
    if (starts_with(bytes, "#?RADIANCE") || starts_with(bytes, "#?RGBE")) return "hdr";
    if (starts_with(bytes, "RIFF") && bytes.size() > 12 && starts_with(bytes.subspan(8), "WEBP")) return "webp";
    if (starts_with(bytes, "BM")) return "bmp";
    std::string ending = name.substr(std::min(name.size(), name.find_last_of('.')));
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending == ".tga") return "targa";
    fail("is no PNG, JPEG, WebP, BMP, TGA, HDR or EXR image; convert it to one of these");
}

void check_size(const OIIO::ImageSpec& spec, size_t file_size) {
    const auto size = [](int number) { return static_cast<uint64_t>(std::max(number, 0)); };
    if (spec.depth > 1) fail("is no flat picture but one with depth; save it flat");
    check_image_size(size(spec.width), size(spec.height), size(spec.nchannels), file_size);
}

// OpenImageIO takes memory for a BMP's rows as soon as it is opened, as much as the header asks for.
void check_bmp_header(Bytes bytes) {
    constexpr size_t kLeast = 26;
    if (bytes.size() < kLeast) fail(std::string("is cut off: it ends within its header") + kSaveAgain);
    const auto number = [&](size_t at, size_t size) {
        uint32_t value = 0;
        for (size_t i = 0; i < size; ++i) value |= static_cast<uint32_t>(bytes[at + i]) << 8 * i;
        return value;
    };
    constexpr uint32_t kOldHeader = 12;  // whose numbers are of 16 bits
    const bool old = number(14, 4) == kOldHeader;
    const uint64_t width = number(18, old ? 2 : 4);
    const uint32_t rows = old ? number(20, 2) : number(22, 4);
    const uint64_t height = rows >> 31 != 0 ? -rows : rows;  // negative: rows from the top down
    if (width > 0 && height > 0) check_image_size(width, height, 1, bytes.size());
}

std::string last_error(OIIO::ImageInput& input) {
    std::string error = input.geterror();
    std::replace(error.begin(), error.end(), '\n', ' ');
    while (!error.empty() && error.back() == ' ') error.pop_back();
    return (error.empty() ? "cannot be decoded" : "cannot be decoded (" + error + ")") + kSaveAgain;
}

// Channels in the file to RGBA: grey is repeated, alpha defaults to `one`.
template <class T>
glm::vec<4, T> rgba_of(const T* texel, int channels, T one) {
    if (channels <= 2) return {texel[0], texel[0], texel[0], channels == 2 ? texel[1] : one};
    return {texel[0], texel[1], texel[2], channels >= 4 ? texel[3] : one};
}

// How many channels are colour and alpha, which OpenImageIO puts first: behind them an EXR may carry others, such as
// depth or the sums that `pathtracer merge` adds.
int color_channels(const OIIO::ImageSpec& spec) {
    const std::vector<std::string>& names = spec.channelnames;
    const bool has_colors = names.size() > 3 && names[0] == "R" && names[1] == "G" && names[2] == "B";
    return !has_colors ? spec.nchannels : names[3] == "A" ? 4 : 3;
}

// Hands the picture over strip by strip, with the number of texels in each: a second copy of all of it is never there,
// and a header that promises too much costs only what the file then really holds.
template <class T, class Take>
void read_strips(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int channels, OIIO::TypeDesc type, Take take) {
    constexpr int STRIP = 256;  // the most rows that a format packs together
    const bool whole = spec.tile_width > 0;
    const size_t row = static_cast<size_t>(spec.width) * static_cast<size_t>(channels);
    const int rows = whole ? spec.height : std::min(spec.height, STRIP);
    std::vector<T> pixels(row * static_cast<size_t>(rows));
    for (int y = 0; y < spec.height; y += rows) {
        const int end = std::min(spec.height, y + rows);
        const bool good =
            whole ? input.read_image(0, 0, 0, channels, type, pixels.data())
                  : input.read_scanlines(0, 0, spec.y + y, spec.y + end, spec.z, 0, channels, type, pixels.data());
        if (!good) fail(last_error(input));
        take(pixels, static_cast<size_t>(spec.width) * static_cast<size_t>(end - y));
    }
}

void fill_bytes(Image& image, const std::vector<uint8_t>& pixels, size_t count, int channels) {
    for (size_t i = 0; i < count; ++i) {
        const glm::u8vec4 c = rgba_of<uint8_t>(&pixels[i * static_cast<size_t>(channels)], channels, 255);
        image.bytes.push_back(uint32_t{c.x} | uint32_t{c.y} << 8 | uint32_t{c.z} << 16 | uint32_t{c.w} << 24);
    }
}

void fill_shorts(Image& image, const std::vector<uint16_t>& pixels, size_t count, int channels) {
    for (size_t i = 0; i < count; ++i) {
        image.shorts.push_back(rgba_of<uint16_t>(&pixels[i * static_cast<size_t>(channels)], channels, 65535));
    }
}

// Whether both channels of an EXR are data of their own (motion, coordinates) and the second is no alpha: red and
// green.
bool are_red_and_green(const OIIO::ImageSpec& spec) {
    const std::vector<std::string>& names = spec.channelnames;
    return names.size() == 2 && names[1] != "A" && !names[1].ends_with(".A");
}

void fill_floats(Image& image, const std::vector<float>& pixels, size_t count, int channels, bool red_and_green) {
    for (size_t i = 0; i < count; ++i) {
        const float* texel = &pixels[i * static_cast<size_t>(channels)];
        image.floats.push_back(red_and_green ? glm::vec4(texel[0], texel[1], 0.0f, 1.0f)
                                             : rgba_of<float>(texel, channels, 1.0f));
    }
}

}  // namespace

Image decode_image(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.empty()) fail(std::string("is empty") + kSaveAgain);
    const std::string format = format_name(bytes, name);
    if (format == "bmp") check_bmp_header(bytes);
    OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(bytes.data()), bytes.size());
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
    if (!input) fail("cannot be decoded: this OpenImageIO has no reader for " + format);
    OIIO::ImageSpec spec;
    if (!input->set_ioproxy(&memory) || !input->open(format, spec, hints)) fail(last_error(*input));
    check_size(spec, bytes.size());
    Image image;
    image.width = static_cast<uint32_t>(spec.width);
    image.height = static_cast<uint32_t>(spec.height);
    image.channels = color_channels(spec);
    const size_t texels = static_cast<size_t>(image.width) * image.height;
    // Without a type, pixels come as they are in the file: OpenImageIO then needs no buffer of its own, which would be
    // of 16 MiB. That takes all channels.
    if (spec.format == OIIO::TypeDesc::UINT8) {
        image.bytes.reserve(texels);
        read_strips<uint8_t>(*input, spec, spec.nchannels, OIIO::TypeUnknown, [&](const auto& pixels, size_t count) {
            fill_bytes(image, pixels, count, spec.nchannels);
        });
    } else if (spec.format == OIIO::TypeDesc::UINT16) {
        image.shorts.reserve(texels);
        read_strips<uint16_t>(*input, spec, spec.nchannels, OIIO::TypeUnknown, [&](const auto& pixels, size_t count) {
            fill_shorts(image, pixels, count, spec.nchannels);
        });
    } else {
        image.is_hdr = spec.format.is_floating_point();
        const int channels = std::min(image.channels, 4);
        const bool as_stored = spec.format == OIIO::TypeDesc::FLOAT && spec.nchannels == channels;
        const OIIO::TypeDesc type = as_stored ? OIIO::TypeUnknown : OIIO::TypeDesc(OIIO::TypeDesc::FLOAT);
        image.floats.reserve(texels);
        const bool red_and_green = are_red_and_green(spec);
        read_strips<float>(*input, spec, channels, type, [&](const auto& pixels, size_t count) {
            fill_floats(image, pixels, count, channels, red_and_green);
        });
    }
    return image;
}

}  // namespace render_system

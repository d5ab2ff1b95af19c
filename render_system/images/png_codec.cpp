// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/images/png_codec.h"

#include <spng.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "render_system/images/image_limits.h"
#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

using PngBytes = std::span<const std::byte>;
using Spng = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

void check_decoded(int code) {
    if (code == SPNG_EMEM) throw std::bad_alloc();
    if (code != SPNG_OK) fail_at("", std::string("cannot be decoded (") + spng_strerror(code) + ")" + kSaveAgain);
}

// The chunks of a PNG that make its picture (PNG 1.2, 3 and 4.1). The others are left out: a texture's meaning is its
// role, not what such chunks say, and a picture with a broken one is as good.
std::vector<std::byte> picture_chunks(PngBytes bytes) {
    std::vector<std::byte> kept(bytes.begin(),
                                bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kSignature.size())));
    bool ended = false;
    for (size_t at = kSignature.size(); !ended;) {
        if (at > bytes.size() || bytes.size() - at < 12)
            fail_at("", std::string("is cut off: it ends before its last chunk") + kSaveAgain);
        uint64_t length = 12;  // the length itself, name and checksum
        for (size_t i = 0; i < 4; ++i) length += static_cast<uint64_t>(bytes[at + i]) << (24 - 8 * i);
        if (length > bytes.size() - at) fail_at("", std::string("is cut off: it ends within a chunk") + kSaveAgain);
        const PngBytes chunk = bytes.subspan(at, length);
        const std::string_view name(reinterpret_cast<const char*>(chunk.data()) + 4, 4);
        ended = name == "IEND";
        const bool needed = ended || name == "IHDR" || name == "PLTE" || name == "tRNS" || name == "IDAT";
        if (needed) kept.insert(kept.end(), chunk.begin(), chunk.end());
        at += length;
    }
    return kept;
}

int channels_of(spng_ctx* png, const spng_ihdr& header) {
    spng_trns colorless{};
    const int alpha = spng_get_trns(png, &colorless) == SPNG_OK ? 1 : 0;
    switch (header.color_type) {
        case SPNG_COLOR_TYPE_GRAYSCALE:
            return 1 + alpha;
        case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
            return 2;
        case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA:
            return 4;
        default:
            return 3 + alpha;
    }
}

// Fills `texels` with those of the picture, RGBA each. Row by row, so that a header that promises too much costs only
// what the file then really holds; where rows are interlaced, they come in another order.
template <class Texel>
void decode_rows(spng_ctx* png, const spng_ihdr& header, int format, std::vector<Texel>& texels) {
    const size_t count = size_t{header.width} * header.height;
    if (header.interlace_method != SPNG_INTERLACE_NONE) {
        texels.resize(count);
        check_decoded(spng_decode_image(png, texels.data(), count * sizeof(Texel), format, SPNG_DECODE_TRNS));
        return;
    }
    texels.reserve(count);
    std::vector<Texel> row(header.width);
    check_decoded(spng_decode_image(png, nullptr, 0, format, SPNG_DECODE_TRNS | SPNG_DECODE_PROGRESSIVE));
    for (uint32_t y = 0; y < header.height; ++y) {
        const int code = spng_decode_row(png, row.data(), row.size() * sizeof(Texel));
        if (code != SPNG_EOI || y + 1 < header.height) check_decoded(code);
        texels.insert(texels.end(), row.begin(), row.end());
    }
}

}  // namespace

bool is_png(std::span<const std::byte> bytes) {
    constexpr size_t kMark = 4;
    return bytes.size() >= kMark && std::memcmp(bytes.data(), kSignature.data(), kMark) == 0;
}

Image decode_png(std::span<const std::byte> bytes) {
    const std::vector<std::byte> picture = picture_chunks(bytes);
    const Spng png(spng_ctx_new(0), &spng_ctx_free);
    if (png == nullptr) throw std::bad_alloc();
    check_decoded(spng_set_png_buffer(png.get(), picture.data(), picture.size()));
    spng_ihdr header{};
    check_decoded(spng_get_ihdr(png.get(), &header));
    Image image;
    image.width = header.width;
    image.height = header.height;
    image.channels = channels_of(png.get(), header);
    check_image_size(header.width, header.height, static_cast<uint64_t>(image.channels), picture.size());
    constexpr uint8_t kWide = 16;
    if (header.bit_depth == kWide)
        decode_rows(png.get(), header, SPNG_FMT_RGBA16, image.shorts);
    else
        decode_rows(png.get(), header, SPNG_FMT_RGBA8, image.bytes);  // red first, as a little-endian word has it
    return image;
}

Result<std::string> encode_png(const ImageToWrite& image) {
    const Spng png(spng_ctx_new(SPNG_CTX_ENCODER), &spng_ctx_free);
    if (png == nullptr) throw std::bad_alloc();
    spng_ihdr header{};
    header.width = image.width;
    header.height = image.height;
    header.bit_depth = 8;
    header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
    std::vector<spng_text> texts;
    char nothing[] = "";
    for (const auto& [name, value] : image.notes) {
        const auto* text = std::get_if<std::string>(&value);
        if (text == nullptr) continue;
        spng_text& note = texts.emplace_back();
        const bool plain =
            std::all_of(text->begin(), text->end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); });
        note.type = plain ? SPNG_TEXT : SPNG_ITXT;    // Latin-1, or UTF-8
        note.text = const_cast<char*>(text->data());  // which it only reads
        note.length = text->size();
        note.language_tag = note.translated_keyword = nothing;
        std::strncpy(note.keyword, name.c_str(), sizeof(note.keyword) - 1);
    }
    constexpr uint32_t kGamma = 45455;  // beside sRGB, for readers that do not know it (PNG 1.2, 4.2.2)
    constexpr size_t kColors = 3;
    int code = spng_set_option(png.get(), SPNG_ENCODE_TO_BUFFER, 1);
    if (code == SPNG_OK) code = spng_set_ihdr(png.get(), &header);
    if (code == SPNG_OK) code = spng_set_srgb(png.get(), 0);
    if (code == SPNG_OK) code = spng_set_gama_int(png.get(), kGamma);
    if (code == SPNG_OK && !texts.empty())
        code = spng_set_text(png.get(), texts.data(), static_cast<uint32_t>(texts.size()));
    if (code == SPNG_OK)
        code = spng_encode_image(png.get(), image.values, kColors * image.width * image.height, SPNG_FMT_PNG,
                                 SPNG_ENCODE_FINALIZE);
    size_t length = 0;
    const std::unique_ptr<void, decltype(&std::free)> bytes(
        code == SPNG_OK ? spng_get_png_buffer(png.get(), &length, &code) : nullptr, &std::free);
    if (code != SPNG_OK) return Status::error(StatusCode::internal, spng_strerror(code));
    return std::string(static_cast<const char*>(bytes.get()), length);
}

}  // namespace render_system

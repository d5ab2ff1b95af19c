// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/sum_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "application/option_values.h"
#include "render_system/images/image_library.h"
#include "render_system/input_file.h"

namespace application {
namespace {

using render_system::ImageFile;
using render_system::PixelSum;
using render_system::Result;
using render_system::SampleType;
using render_system::Status;
using render_system::StatusCode;

constexpr int kColors = 3;
constexpr int kWords = 12;  // of a pixel's sum: R, G, B, of each the upper and the lower half of high and of low

/// Names that OpenImageIO, which orders channels, leaves in this order behind R, G and B.
std::vector<std::string> channel_names() {
    std::vector<std::string> names = {"R", "G", "B"};
    for (int word = 0; word < kWords; ++word) names.push_back(fmt::format("sum.{:02}", word));
    return names;
}

/// A pixel as the file has it.
struct Row {
    float color[kColors];
    uint32_t words[kWords];
};

Row row_of(const PixelSum& sum, uint32_t samples) {
    Row row{};
    const glm::vec3 mean = mean_of(sum, samples);
    for (int channel = 0; channel < kColors; ++channel) {
        const auto high = std::bit_cast<uint64_t>(sum.high[channel]);
        const auto low = std::bit_cast<uint64_t>(sum.low[channel]);
        row.color[channel] = mean[channel];
        uint32_t* words = row.words + channel * 4;
        words[0] = static_cast<uint32_t>(high >> 32);
        words[1] = static_cast<uint32_t>(high);
        words[2] = static_cast<uint32_t>(low >> 32);
        words[3] = static_cast<uint32_t>(low);
    }
    return row;
}

PixelSum sum_of(const uint32_t* words) {
    PixelSum sum;
    for (int channel = 0; channel < kColors; ++channel, words += 4) {
        sum.high[channel] = std::bit_cast<double>(uint64_t{words[0]} << 32 | words[1]);
        sum.low[channel] = std::bit_cast<int64_t>(uint64_t{words[2]} << 32 | words[3]);
    }
    return sum;
}

Status no_part(const std::string& file, const std::string& what) {
    return Status::error(StatusCode::unreadable,
                         fmt::format("{}: {}; give .exr files that pathtracer render --samples A:B wrote", file, what));
}

/// What the file says of itself.
Status read_notes(const ImageFile& file, PicturePart& part) {
    part.run = RunIdentity::read(file.text("pathtracerRun"));
    part.ranges = ranges_of_text(file.text("sampleRanges"));
    if (!part.run.value(kFilterEntry).empty())
        return Status::invalid(fmt::format(
            "{}: was made with --filter, and what a filter leaves cannot be added; render it without", part.file));
    if (part.run.entries.empty() || part.ranges.empty())
        return no_part(part.file, "it does not say which samples of which picture it holds");
    uint64_t samples = 0;
    for (const SampleRange& range : part.ranges) samples += range.count();
    if (part.ranges.back().end > MAX_SAMPLES || static_cast<uint64_t>(file.number("samples")) != samples)
        return no_part(part.file, "its number of samples is not that of its ranges");
    if (part.run.value("--size") != fmt::format("{}x{}", file.width, file.height))
        return no_part(part.file, "its size is not the one it was rendered in");
    part.sums.samples = static_cast<uint32_t>(samples);
    return Status::success();
}

Status read_pixels(ImageFile& file, PicturePart& part) {
    const size_t pixels = part.sums.pixels.size();
    if (part.exact) {
        std::vector<uint32_t> words(pixels * kWords);
        const std::string error = file.read(kColors, kColors + kWords, SampleType::u32, words.data());
        if (!error.empty()) return no_part(part.file, error);
        for (size_t i = 0; i < pixels; ++i) part.sums.pixels[i] = sum_of(&words[i * kWords]);
        return Status::success();
    }
    std::vector<float> colors(pixels * kColors);
    const std::string error = file.read(0, kColors, SampleType::f32, colors.data());
    if (!error.empty()) return no_part(part.file, error);
    for (size_t i = 0; i < pixels; ++i) {
        const glm::vec3 mean(colors[i * 3], colors[i * 3 + 1], colors[i * 3 + 2]);
        add_sample(part.sums.pixels[i], mean * static_cast<float>(part.sums.samples));
    }
    return Status::success();
}

}  // namespace

Result<std::string> encode_sums(const SampleSums& sums, const PictureNotes& notes) {
    render_system::ImageToWrite image{"exr", sums.width, sums.height, channel_names(), {}};
    image.types.assign(kColors, SampleType::f32);
    image.types.resize(kColors + kWords, SampleType::u32);
    image.notes = {
        {"samples", static_cast<int>(notes.samples)}, {"sampleRanges", notes.ranges}, {"pathtracerRun", notes.run}};
    std::vector<Row> rows;
    rows.reserve(sums.pixels.size());
    for (const PixelSum& pixel : sums.pixels) rows.push_back(row_of(pixel, sums.samples));
    image.values = rows.data();
    auto bytes = render_system::encode_image(image);
    if (!bytes.ok()) bytes.status.message = "cannot encode the sums as exr: " + bytes.status.message;
    return bytes;
}

Result<PicturePart> read_part(const std::string& file) {
    if (Status status = render_system::check_input_file(file); !status.ok()) return status;
    const auto library = render_system::image_library();
    if (!library.ok()) return library.status;
    auto opened = (*library)->open(file);
    if (!opened.ok() || (*opened)->format != "openexr")
        return no_part(file, opened.ok() ? "it is no EXR" : opened.status.message);
    ImageFile& image = **opened;
    const bool sums = image.channels == channel_names();
    const bool sound = image.width > 0 && image.height > 0 && image.width <= static_cast<int>(MAX_SIDE) &&
                       image.height <= static_cast<int>(MAX_SIDE) &&
                       static_cast<uint64_t>(image.width) * static_cast<uint64_t>(image.height) <= MAX_PIXELS &&
                       image.is_flat && (sums || image.channels.size() == kColors);
    if (!sound) return no_part(file, "its size or its channels are none of ours");
    PicturePart part;
    part.file = file;
    part.exact = sums;
    if (Status status = read_notes(image, part); !status.ok()) return status;
    const uint32_t samples = part.sums.samples;
    part.sums = SampleSums(static_cast<uint32_t>(image.width), static_cast<uint32_t>(image.height), false);
    part.sums.samples = samples;
    if (Status status = read_pixels(image, part); !status.ok()) return status;
    return part;
}

}  // namespace application

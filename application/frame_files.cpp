// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/frame_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "application/comparison/picture_file.h"
#include "application/option_values.h"
#include "application/sampling/scene_digest.h"

namespace application {
namespace {

using render_system::Result;
using render_system::Status;

/// The kernels that --kernels brings, name by name: they may be others when the sequence goes on.
std::string kernels_text(const std::string& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (entry.is_regular_file(error)) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    Digest digest;
    for (const std::filesystem::path& file : files) {
        digest.add(file.filename().string());
        std::ifstream stream(file, std::ios::binary);
        digest.add(std::string(std::istreambuf_iterator<char>(stream), {}));
    }
    return " kernels " + digest.hex();
}

/// `text` with the checksum of the values that the file holds.
template <class Value>
std::string sealed(const std::string& text, const Channels<Value>& image) {
    Digest digest;
    digest.add_bytes(image.rgb.data(), image.rgb.size() * sizeof(Value));
    return text + " pixels " + digest.hex();
}

/// A PNG's last chunk, which no pixel needs.
bool ends_whole(const std::string& file, ImageKind kind) {
    constexpr std::string_view LAST = "IEND\xAE\x42\x60\x82";
    std::string end(LAST.size(), '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
    return kind == ImageKind::exr || (stream.read(end.data(), static_cast<std::streamsize>(end.size())) && end == LAST);
}

}  // namespace

Result<std::string> frame_file(const std::string& pattern, uint32_t number) {
    const size_t name = pattern.find_last_of('/') == std::string::npos ? 0 : pattern.find_last_of('/') + 1;
    const size_t last = pattern.find_last_of('#');
    if (last == std::string::npos || last < name)
        return Status::invalid(fmt::format(
            "-o {}: the name has no place for the number of a frame; give one with ####, e.g. frame_####.png",
            pattern));
    size_t first = last;
    while (first > name && pattern[first - 1] == '#') --first;
    return pattern.substr(0, first) + fmt::format("{:0{}}", number, last + 1 - first) + pattern.substr(last + 1);
}

bool is_frame_name(const std::string& pattern, const FrameRange& frames, const std::string& name) {
    const std::string filename = std::filesystem::path(pattern).filename().string();
    const size_t last = filename.find_last_of('#');
    const size_t behind = filename.size() - 1 - last, before = filename.find_last_not_of('#', last) + 1;
    if (name.size() <= before + behind) return false;
    const std::string_view digits = std::string_view(name).substr(before, name.size() - before - behind);
    const auto number = parse_number(digits, frames.first, frames.end - 1);
    return number.ok() && std::filesystem::path(*frame_file(pattern, *number)).filename() == name;
}

std::vector<std::filesystem::path> frames_there(const std::string& pattern, const FrameRange& frames) {
    const std::filesystem::path folder = std::filesystem::path(pattern).parent_path();
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, error)) {
        const std::string name = entry.path().filename().string();
        if (is_frame_name(pattern, frames, name)) files.push_back(folder / name);
    }
    return files;
}

double frame_time(const Options& options, uint32_t number) { return static_cast<double>(number) / options.fps; }

std::string sequence_text(const Options& options, const render_system::HostScene& scene) {
    std::string text =
        fmt::format("version {} textures {} sky {} size {}x{} spp {} seed {} max-path-length {} core {}",
                    PORTTOOL_VERSION, texture_digest(scene), sky_digest(scene.sky()), options.width, options.height,
                    options.spp.front(), options.seed, options.max_path_length, fmt::join(options.cores, ","));
    if (!options.russian_roulette) text += " no-roulette";
    if (!options.next_event_estimation) text += " no-nee";
    if (options.indirect_limit > 0.0f) text += fmt::format(" clamp {}", options.indirect_limit);
    if (options.exact) text += " exact";
    if (options.filter != FilterMode::none) text += fmt::format(" filter {}", static_cast<int>(options.filter));
    if (options.filter == FilterMode::temporal) text += fmt::format(" from {}", options.frames->first);
    if (!options.kernels.empty()) text += kernels_text(options.kernels);
    return text + fmt::format(" exposure {} tone-map {}", options.exposure, static_cast<int>(options.tone_map));
}

std::string frame_text(const std::string& sequence, const render_system::HostScene& scene,
                       const render_system::ViewPyramid& view, double seconds) {
    return fmt::format("{} scene {} view {} time {}", sequence, pose_digest(scene), view_digest(view), seconds);
}

Result<std::string> encode_frame(const Picture& picture, ImageKind kind, const Options& options,
                                 const std::string& text) {
    if (kind == ImageKind::exr) {
        const Channels<float> image = linear_values(picture);
        return encode_exr(image, {.made_with = sealed(text, image)});
    }
    const Channels<uint8_t> image = srgb_levels(picture, options.exposure, options.tone_map);
    return encode_png(image, {.made_with = sealed(text, image)});
}

bool holds_frame(const std::string& file, ImageKind kind, const std::string& text) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return false;  // opening a pipe would wait
    const std::string said = made_with(file);
    if (!said.starts_with(text) || !ends_whole(file, kind)) return false;
    const auto read = read_picture_file(file);
    if (!read.ok()) return false;
    return said == (kind == ImageKind::exr ? sealed(text, read->forms.linear) : sealed(text, read->forms.levels));
}

}  // namespace application

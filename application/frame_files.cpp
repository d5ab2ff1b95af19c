// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/frame_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <fstream>
#include <string_view>

#include "application/comparison/picture_file.h"
#include "application/option_values.h"
#include "application/sampling/scene_digest.h"
#include "application/scene_setup.h"

namespace application {
namespace {

using render_system::Result;
using render_system::Status;

/// FNV-1a of a file's bytes: tells an edited scene from the one that was rendered.
uint64_t fingerprint_of_file(const std::string& name) {
    uint64_t hash = 0xCBF29CE484222325u;
    std::ifstream file(name, std::ios::binary);
    std::array<char, 65536> bytes;
    while (file.read(bytes.data(), bytes.size()), file.gcount() > 0) {
        for (std::streamsize i = 0; i < file.gcount(); ++i)
            hash = (hash ^ static_cast<unsigned char>(bytes[static_cast<size_t>(i)])) * 0x100000001B3u;
    }
    return hash;
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

std::string camera_text(const Options& options, bool framed) {
    std::string text;
    if (!options.camera.file.empty()) text += fmt::format(" camera {:016x}", fingerprint_of_file(options.camera.file));
    if (options.camera.index) text += fmt::format(" camera {}", *options.camera.index);
    if (options.look_at)
        text += fmt::format(" look-at {},{}", fmt::join(options.look_at->eye, ","),
                            fmt::join(options.look_at->target, ","));
    if (framed && !options.look_at) text += fmt::format(" framed {}", frame_time(options, options.frames->first));
    if (options.vertical_fov) text += fmt::format(" fov {}", *options.vertical_fov);
    if (options.aperture) text += fmt::format(" aperture {}", *options.aperture);
    if (options.focus) text += fmt::format(" focus {}", *options.focus);
    return text;
}

std::string sky_text(const Options& options) {
    if (!options.sky.file.empty()) return fmt::format(" sky {:016x}", fingerprint_of_file(options.sky.file));
    if (options.sky.radiance) return fmt::format(" sky {}", fmt::join(*options.sky.radiance, ","));
    // Whether there is a studio around it was decided at the first frame.
    return fmt::format(" sky at {}", frame_time(options, options.frames->first));
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

std::vector<std::filesystem::path> frames_there(const std::string& pattern, const FrameRange& frames) {
    const std::filesystem::path folder = std::filesystem::path(pattern).parent_path();
    const size_t name_at = pattern.size() - std::filesystem::path(pattern).filename().string().size();
    const size_t behind = pattern.size() - 1 - pattern.find_last_of('#');
    const size_t before = pattern.find_last_not_of('#', pattern.find_last_of('#')) + 1 - name_at;
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, error)) {
        const std::string name = entry.path().filename().string();
        if (name.size() <= before + behind) continue;
        const std::string_view digits = std::string_view(name).substr(before, name.size() - before - behind);
        const auto number = parse_number(digits, frames.first, frames.end - 1);
        if (number.ok() && std::filesystem::path(*frame_file(pattern, *number)).filename() == name)
            files.push_back(folder / name);
    }
    return files;
}

double frame_time(const Options& options, uint32_t number) { return static_cast<double>(number) / options.fps; }

std::string sequence_text(const Options& options, bool framed) {
    std::string text =
        fmt::format("scene {:016x} size {}x{} spp {} seed {} max-path-length {} core {}",
                    fingerprint_of_file(scene_path(options.scene)), options.width, options.height, options.spp.front(),
                    options.seed, options.max_path_length, fmt::join(options.cores, ","));
    if (!options.russian_roulette) text += " no-roulette";
    if (!options.next_event_estimation) text += " no-nee";
    if (options.indirect_limit > 0.0f) text += fmt::format(" clamp {}", options.indirect_limit);
    if (options.exact) text += " exact";
    if (options.filter != FilterMode::none) text += fmt::format(" filter {}", static_cast<int>(options.filter));
    if (!options.variant.empty()) text += fmt::format(" variant {}", options.variant);
    if (!options.animation.empty()) text += fmt::format(" animation {}", options.animation);
    if (!options.kernels.empty()) text += fmt::format(" kernels {}", options.kernels);
    text += camera_text(options, framed) + sky_text(options);
    return text + fmt::format(" exposure {} tone-map {}", options.exposure, static_cast<int>(options.tone_map));
}

std::string frame_text(const std::string& sequence, double seconds) {
    return fmt::format("{} time {}", sequence, seconds);
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

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "application/options.h"
#include "render_system/status.h"

// From the text of one option to its value. Each function is pure; where the text is nonsense, the status names the
// text, what was expected and an example (the caller puts the option's name in front).

namespace application {

using render_system::Result;

constexpr uint32_t MAX_SIDE = 32768;                 ///< pixels
constexpr uint64_t MAX_PIXELS = uint64_t{1} << 27;   ///< 2 GiB of float radiance
constexpr uint32_t MAX_SAMPLES = uint32_t{1} << 24;  ///< a float counts that far
constexpr uint32_t MAX_PATH_SEGMENTS = 65535;
constexpr uint32_t MAX_THREADS = 1024;
constexpr uint32_t MAX_FRAME = 100'000'000;

struct Size {
    uint32_t width = 0;
    uint32_t height = 0;
};

Result<Size> parse_size(std::string_view text);

/// A whole number from `low` to `high`.
Result<uint32_t> parse_number(std::string_view text, uint32_t low, uint32_t high);

/// One or more sample counts, separated by commas.
Result<std::vector<uint32_t>> parse_sample_counts(std::string_view text);

/// An SSIM from -1 to 1.
Result<double> parse_ssim(std::string_view text);

/// A probability above 0 and up to 0.5.
Result<double> parse_alpha(std::string_view text);

/// Mebibytes, as bytes.
Result<uint64_t> parse_mebibytes(std::string_view text);

/// Digits alone are an index, everything else is a file's name.
Result<CameraChoice> parse_camera(std::string_view text);

/// `auto`, or names of cores in order of preference, separated by commas, each once: source, target, null, and those
/// of which there is a module.
Result<std::vector<std::string>> parse_cores(std::string_view text);

/// Six numbers separated by commas: the eye, and where it looks.
Result<LookAt> parse_look_at(std::string_view text);

/// Degrees between 0 and 180, as radians.
Result<float> parse_fov(std::string_view text);

/// Two sample numbers, first and end: 0:64 is the first 64 samples.
Result<std::array<uint32_t, 2>> parse_sample_range(std::string_view text);

/// Seconds above 0, from `90`, `90s`, `1.5m` or `2h`.
Result<double> parse_duration(std::string_view text);

/// A noise above 0, as noise_of measures it.
Result<double> parse_noise(std::string_view text);

/// A length above 0, in scene units.
Result<float> parse_length(std::string_view text);

/// A radiance above 0.
Result<float> parse_limit(std::string_view text);

/// Stops from -100 to 100.
Result<float> parse_exposure(std::string_view text);

/// Seconds from -1e9 to 1e9.
Result<double> parse_time(std::string_view text);

/// Frames a second, above 0.
Result<double> parse_fps(std::string_view text);

/// A:B, two whole numbers: frames from A up to, but without, B.
Result<FrameRange> parse_frames(std::string_view text);

/// Three numbers separated by commas are a radiance; a name with a dot and no comma is a file.
Result<SkyChoice> parse_sky(std::string_view text);

}  // namespace application

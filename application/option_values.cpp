// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "render_system/core_modules.h"
#include "render_system/scene_limits.h"

namespace application {
namespace {

using render_system::Status;

/// The whole of `text` as a number, or none. Takes neither white space nor a leading plus.
template <class Number>
std::optional<Number> number_from(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        const size_t at = text.find(separator);
        parts.push_back(text.substr(0, at));
        if (at == std::string_view::npos) return parts;
        text.remove_prefix(at + 1);
    }
}

bool is_digits(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

Result<Size> parse_size(std::string_view text) {
    const auto parts = split(text, 'x');
    std::optional<uint32_t> width, height;
    if (parts.size() == 2) {
        width = number_from<uint32_t>(parts[0]);
        height = number_from<uint32_t>(parts[1]);
    }
    const bool fits = width && height && *width >= 1 && *height >= 1 && *width <= MAX_SIDE && *height <= MAX_SIDE &&
                      uint64_t{*width} * *height <= MAX_PIXELS;
    if (!fits) {
        return Status::invalid(
            fmt::format("'{}' is no size that can be rendered; give WIDTHxHEIGHT in pixels, each 1 to {} "
                        "and at most {} pixels in all, e.g. 640x360",
                        text, MAX_SIDE, MAX_PIXELS));
    }
    return Size{*width, *height};
}

Result<uint32_t> parse_number(std::string_view text, uint32_t low, uint32_t high) {
    const auto number = number_from<uint32_t>(text);
    if (!number || *number < low || *number > high) {
        return Status::invalid(fmt::format("'{}' is not a whole number from {} to {}", text, low, high));
    }
    return *number;
}

Result<std::vector<uint32_t>> parse_sample_counts(std::string_view text) {
    std::vector<uint32_t> counts;
    for (const std::string_view part : split(text, ',')) {
        const auto count = parse_number(part, 1, MAX_SAMPLES);
        if (!count.ok()) return Status::invalid(count.status.message + "; give sample counts such as 1,4,16");
        counts.push_back(*count);
    }
    return counts;
}

Result<double> parse_ssim(std::string_view text) {
    const auto limit = number_from<double>(text);
    if (!limit || !(*limit >= -1.0 && *limit <= 1.0)) {
        return Status::invalid(fmt::format("'{}' is no SSIM; give a number from -1 to 1, e.g. 0.999", text));
    }
    return *limit;
}

Result<double> parse_alpha(std::string_view text) {
    const auto alpha = number_from<double>(text);
    if (!alpha || !(*alpha > 0.0 && *alpha <= 0.5)) {
        return Status::invalid(
            fmt::format("'{}' is no such probability; give a number above 0 and up to 0.5, e.g. 0.001", text));
    }
    return *alpha;
}

Result<uint64_t> parse_mebibytes(std::string_view text) {
    constexpr uint32_t MOST = 1u << 30;
    const auto mebibytes = parse_number(text, 1, MOST);
    if (!mebibytes.ok()) return Status::invalid(mebibytes.status.message + " (MiB)");
    return uint64_t{*mebibytes} << 20;
}

Result<CameraChoice> parse_camera(std::string_view text) {
    CameraChoice choice;
    if (text.empty()) return Status::invalid("is empty; give a JSON file or the number of a camera of the scene");
    if (text.front() == '-' && is_digits(text.substr(1)))
        return Status::invalid(fmt::format("'{}': cameras of the scene are counted from 0", text));
    if (!is_digits(text)) {
        choice.file = text;
        return choice;
    }
    const auto index = parse_number(text, 0, 1u << 30);
    if (!index.ok()) return index.status;
    choice.index = *index;
    return choice;
}

Result<std::vector<std::string>> parse_cores(std::string_view text) {
    if (text == "auto") return std::vector<std::string>{"auto"};
    std::set<std::string> known = {"null", "source", "target"};
    for (std::string& id : render_system::core_module_ids()) known.insert(std::move(id));
    std::vector<std::string> cores;
    for (const std::string_view part : split(text, ',')) {
        const std::string core(part);
        if (known.find(core) == known.end())
            return Status::invalid(fmt::format("'{}' is not one of auto, {}", core, fmt::join(known, ", ")));
        if (std::find(cores.begin(), cores.end(), core) != cores.end())
            return Status::invalid(fmt::format("'{}' names {} twice; once is enough", text, core));
        cores.push_back(core);
    }
    return cores;
}

Result<LookAt> parse_look_at(std::string_view text) {
    const auto parts = split(text, ',');
    std::array<float, 6> numbers{};
    bool sound = parts.size() == numbers.size();
    for (size_t i = 0; sound && i < numbers.size(); ++i) {
        const auto value = number_from<float>(parts[i]);
        sound = value && std::isfinite(*value);
        if (sound) numbers[i] = *value;
    }
    LookAt view{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
    if (sound && view.eye != view.target) return view;
    return Status::invalid(fmt::format(
        "'{}' is no view; give the eye and another point that it looks at, X,Y,Z,X,Y,Z, e.g. 0,1,5,0,1,0", text));
}

Result<float> parse_fov(std::string_view text) {
    constexpr float DEGREE = 0.017453292519943295f;
    const auto degrees = number_from<float>(text);
    if (degrees && *degrees >= 0.001f && *degrees <= 179.0f) return *degrees * DEGREE;
    return Status::invalid(fmt::format("'{}' is no vertical field of view; give degrees from 0.001 to 179", text));
}

Result<std::array<uint32_t, 2>> parse_sample_range(std::string_view text) {
    const auto parts = split(text, ':');
    if (parts.size() == 2) {
        const auto first = number_from<uint32_t>(parts[0]);
        const auto end = number_from<uint32_t>(parts[1]);
        if (first && end && *first < *end && *end <= MAX_SAMPLES) return std::array<uint32_t, 2>{*first, *end};
    }
    return Status::invalid(fmt::format(
        "'{}' is no range of samples; give FIRST:END with FIRST below END and END at most {}, e.g. 0:64 for "
        "the first 64",
        text, MAX_SAMPLES));
}

Result<double> parse_duration(std::string_view text) {
    double unit = 1.0;
    std::string_view digits = text;
    if (!text.empty() && std::string_view("smh").find(text.back()) != std::string_view::npos) {
        unit = text.back() == 'm' ? 60.0 : text.back() == 'h' ? 3600.0 : 1.0;
        digits.remove_suffix(1);
    }
    const auto number = number_from<double>(digits);
    constexpr double YEAR = 3600.0 * 24.0 * 366.0;
    if (number && *number > 0.0 && *number * unit <= YEAR) return *number * unit;
    return Status::invalid(
        fmt::format("'{}' is no duration; give one above 0 and of a year at most, such as 90s, 5m or 2h", text));
}

Result<double> parse_noise(std::string_view text) {
    const auto noise = number_from<double>(text);
    if (noise && *noise > 0.0 && std::isfinite(*noise)) return *noise;
    return Status::invalid(fmt::format("'{}' is no noise; give a number above 0, e.g. 0.02", text));
}

Result<float> parse_length(std::string_view text) {
    const auto length = number_from<float>(text);
    if (length && *length > 0.0f && std::isfinite(*length)) return *length;
    return Status::invalid(fmt::format("'{}' is no length; give one above 0 in scene units, e.g. 0.1", text));
}

Result<float> parse_limit(std::string_view text) {
    const auto limit = number_from<float>(text);
    if (limit && *limit > 0.0f && std::isfinite(*limit)) return *limit;
    return Status::invalid(fmt::format("'{}' is no limit; give a radiance above 0, e.g. 10", text));
}

Result<float> parse_exposure(std::string_view text) {
    const auto stops = number_from<float>(text);
    if (stops && *stops >= -100.0f && *stops <= 100.0f) return *stops;
    return Status::invalid(
        fmt::format("'{}' is no exposure; give stops from -100 to 100, e.g. 1 for twice as bright", text));
}

Result<double> parse_time(std::string_view text) {
    const auto seconds = number_from<double>(text);
    if (seconds && *seconds >= -1e9 && *seconds <= 1e9) return *seconds;
    return Status::invalid(fmt::format("'{}' is no time; give seconds from -1e9 to 1e9, e.g. 1.5", text));
}

Result<double> parse_fps(std::string_view text) {
    const auto rate = number_from<double>(text);
    if (rate && *rate >= 1e-6 && *rate <= 1e6) return *rate;
    return Status::invalid(fmt::format("'{}' is no rate; give frames a second from 1e-6 to 1e6, e.g. 24", text));
}

Result<FrameRange> parse_frames(std::string_view text) {
    const auto parts = split(text, ':');
    std::optional<uint32_t> first, end;
    if (parts.size() == 2) {
        first = number_from<uint32_t>(parts[0]);
        end = number_from<uint32_t>(parts[1]);
    }
    if (!first || !end || *end > MAX_FRAME)
        return Status::invalid(
            fmt::format("'{}' is no range of frames; give A:B, whole numbers up to {}, e.g. 0:24 for frames 0 to 23",
                        text, MAX_FRAME));
    if (*first < *end) return FrameRange{*first, *end};
    return Status::invalid(fmt::format("'{}' holds no frames{}; A:B are frames A to B - 1, e.g. {}:{}", text,
                                       *first > *end ? ": it runs backwards" : "", std::min(*first, *end),
                                       std::max(*first, *end) + 1));
}

Result<SkyChoice> parse_sky(std::string_view text) {
    SkyChoice choice;
    const auto parts = split(text, ',');
    if (parts.size() == 1 && text.find('.') != std::string_view::npos && !number_from<float>(text)) {
        choice.file = text;
        return choice;
    }
    std::array<float, 3> radiance{};
    bool sound = parts.size() == radiance.size();
    for (size_t i = 0; sound && i < radiance.size(); ++i) {
        const auto value = number_from<float>(parts[i]);
        sound = value && *value >= 0.0f && *value <= render_system::BRIGHTEST_LIGHT;
        if (sound) radiance[i] = *value;
    }
    if (!sound) {
        return Status::invalid(
            fmt::format("'{}' is no sky; give a linear radiance R,G,B of three numbers from 0 to {:g}, e.g. "
                        "1,1,1, or the file of an HDR map",
                        text, render_system::BRIGHTEST_LIGHT));
    }
    choice.radiance = radiance;
    return choice;
}

}  // namespace application

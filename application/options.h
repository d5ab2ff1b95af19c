// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "application/tone_map.h"

namespace application {

enum class ColorMode { automatic, always, never };
enum class Format { text, json };

/// `--filter`: nothing, neighbours in the picture, or those and earlier frames.
enum class FilterMode { none, spatial, temporal };

/// As the command line has it.
constexpr const char* name_of(FilterMode filter) {
    return filter == FilterMode::none ? "none" : filter == FilterMode::spatial ? "spatial" : "temporal";
}

/// `--camera`: a file, the number of a camera node, or (neither) whatever the scene offers.
struct CameraChoice {
    std::string file;
    std::optional<uint32_t> index;
};

/// `--look-at`: a view by two points, y up.
struct LookAt {
    std::array<float, 3> eye;
    std::array<float, 3> target;
};

/// `--frames`: from `first` up to `end`, which is not among them.
struct FrameRange {
    uint32_t first = 0;
    uint32_t end = 0;
};

/// `--sky`: a radiance, the file of a map, or (neither) what scene and camera file say.
struct SkyChoice {
    std::optional<std::array<float, 3>> radiance;
    std::string file;
};

/// render: which samples are taken, when it stops, and what is kept on the way.
struct SamplingOptions {
    std::optional<std::array<uint32_t, 2>> range;  ///< `--samples`: first and end
    std::optional<double> checkpoint;              ///< seconds between two
    std::optional<double> time_limit;              ///< seconds
    std::optional<double> noise;                   ///< as noise_of measures it
};

/// Everything that a command line can say, with the defaults of one that says nothing.
struct Options {
    bool quiet = false;
    bool verbose = false;
    bool progress = false;  ///< a progress bar even where stderr is no terminal
    ColorMode color = ColorMode::automatic;
    Format format = Format::text;

    std::string scene;
    std::vector<std::string> images_a;  ///< compare: image files in place of a scene; one or a set
    std::vector<std::string> images_b;
    std::vector<std::string> inputs;         ///< merge: the files to add
    std::string output;                      ///< empty: the command's own default
    std::string log;                         ///< view: empty: none
    std::string stats;                       ///< empty: none
    std::vector<std::string> cores{"auto"};  ///< in order of preference, or auto alone
    bool core_given = false;
    uint32_t width = 640;
    uint32_t height = 360;
    std::vector<uint32_t> spp{16};  ///< more than one element only for `compare`
    bool spp_given = false;
    SamplingOptions sampling;
    uint32_t seed = 0;
    std::optional<uint32_t> seed_target;  ///< compare: another seed for the target core
    uint32_t max_path_length = 8;
    bool russian_roulette = true;
    bool next_event_estimation = true;
    float indirect_limit = 0.0f;  ///< `--clamp`; 0: none
    bool exact = false;
    std::string variant;               ///< of KHR_materials_variants; empty: the file's own materials
    bool allow_outside = false;        ///< the scene may name files outside its folder
    std::string animation;             ///< name or number; empty: all
    double time = 0.0;                 ///< seconds, at which an animated scene is shown
    std::optional<FrameRange> frames;  ///< render: a sequence of pictures
    double fps = 24.0;                 ///< frames a second
    bool time_given = false;
    bool fps_given = false;
    bool resume = false;  ///< from a checkpoint; of `frames` those that are there already stay
    CameraChoice camera;
    std::optional<LookAt> look_at;
    std::optional<float> vertical_fov;  ///< radians
    std::optional<float> aperture;      ///< radius of a thin lens
    std::optional<float> focus;         ///< where it is sharp; none: where `look_at` looks
    SkyChoice sky;
    FilterMode filter = FilterMode::none;
    float exposure = 0.0f;  ///< stops, of PNGs
    ToneMap tone_map = ToneMap::none;
    uint32_t threads = 0;           ///< 0: all
    uint64_t gpu_memory_limit = 0;  ///< bytes, 0: the device-local heap
    std::string kernels;            ///< empty: those built into the program
    std::optional<double> limit_ssim;
    bool bias = false;     ///< compare: bias told from noise
    double alpha = 0.001;  ///< compare --bias: how often equal pictures may be called different
    bool locate = false;   ///< compare: where the cores part
    std::string evidence;  ///< compare --locate: the file for porttool check --evidence; empty: none
};

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/declare_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "application/option_values.h"

namespace application {
namespace {

/// An option whose text goes through `parse` and, where that succeeds, on to `store`.
template <class Parse, class Store>
CLI::Option* add_parsed(CLI::App& app, const std::string& name, Parse parse, Store store, const std::string& help) {
    const auto callback = [name, parse, store](const std::string& text) {
        auto result = parse(text);
        if (!result.ok()) throw CLI::ValidationError(name, result.status.message);
        store(*result);
    };
    return app.add_option_function<std::string>(name, callback, help);
}

CLI::Option* add_number(CLI::App& app, const std::string& name, uint32_t& value, uint32_t low, uint32_t high,
                        const std::string& help) {
    return add_parsed(
        app, name, [low, high](const std::string& text) { return parse_number(text, low, high); },
        [&value](uint32_t number) { value = number; }, help);
}

/// A file or folder. An empty name is a slip (an unset variable in a script, say), not a wish for the default.
CLI::Option* add_name(CLI::App& app, const std::string& name, std::string& value, const std::string& help) {
    const auto check = [](const std::string& text) {
        return text.empty() ? std::string("the name is empty; give one, or leave the option out") : std::string();
    };
    return app.add_option(name, value, help)->check(CLI::Validator(check, ""));
}

template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value, std::map<std::string, Value> choices,
                        const std::string& help) {
    const auto callback = [name, &value, choices](const std::string& text) {
        const auto found = choices.find(text);
        if (found != choices.end()) {
            value = found->second;
            return;
        }
        std::string known;
        for (const auto& [key, unused] : choices) known += (known.empty() ? "" : ", ") + key;
        throw CLI::ValidationError(name, "'" + text + "' is not one of " + known);
    };
    return app.add_option_function<std::string>(name, callback, help);
}

/// What is there by that name is a file, whatever it is called: its reader knows what is wrong with it.
Result<SkyChoice> sky_of(const std::string& text) {
    auto sky = parse_sky(text);
    std::error_code error;
    if (!sky.ok() && std::filesystem::exists(text, error)) return SkyChoice{.radiance = {}, .file = text};
    return sky;
}

void declare_format(CLI::App& app, Options& options) {
    add_choice<Format>(app, "--format", options.format, {{"text", Format::text}, {"json", Format::json}},
                       "What is printed on stdout: text or json (text)")
        ->type_name("F");
}

void declare_picture(CLI::App& app, Options& options) {
    add_parsed(
        app, "--size", parse_size,
        [&options](Size size) {
            options.width = size.width;
            options.height = size.height;
        },
        "Pixels (640x360)")
        ->type_name("WxH");
    add_parsed(
        app, "--time", parse_time,
        [&options](double seconds) {
            options.time = seconds;
            options.time_given = true;
        },
        "The time at which an animated scene is shown, in seconds (0)")
        ->type_name("T");
    add_name(app, "--animation", options.animation,
             "The animation to play (all; of those that move the same, the file's first)")
        ->type_name("NAME|INDEX");
    add_number(app, "--seed", options.seed, 0, UINT32_MAX, "Seed of the random numbers (0)")->type_name("N");
    add_parsed(
        app, "--camera", parse_camera, [&options](const CameraChoice& camera) { options.camera = camera; },
        "A camera file (JSON), or the number of a camera in the scene (0)")
        ->type_name("FILE|INDEX");
    add_parsed(
        app, "--look-at", parse_look_at, [&options](const LookAt& view) { options.look_at = view; },
        "The eye and where it looks, y up (frames the scene where it has no camera)")
        ->type_name("X,Y,Z,X,Y,Z");
    add_parsed(
        app, "--fov", parse_fov, [&options](float fov) { options.vertical_fov = fov; },
        "Vertical field of view (the camera's; 40)")
        ->type_name("DEGREES");
    add_parsed(
        app, "--aperture", parse_length, [&options](float radius) { options.aperture = radius; },
        "Radius of a thin lens, in scene units (a pinhole)")
        ->type_name("A");
    add_parsed(
        app, "--focus", parse_length, [&options](float distance) { options.focus = distance; },
        "How far off the lens is sharp, in scene units (where --look-at looks)")
        ->type_name("D");
    add_parsed(
        app, "--sky", sky_of, [&options](const SkyChoice& sky) { options.sky = sky; },
        "Constant radiance, or an HDR map (black; a neutral studio where the scene does not light itself)")
        ->type_name("R,G,B|FILE.hdr");
    add_parsed(
        app, "--exposure", parse_exposure, [&options](float stops) { options.exposure = stops; },
        "Stops by which a PNG is brighter (0)")
        ->type_name("EV");
    add_choice<ToneMap>(
        app, "--tone-map", options.tone_map,
        {{"none", ToneMap::none}, {"neutral", ToneMap::neutral}, {"aces", ToneMap::aces}, {"agx", ToneMap::agx}},
        "What brings a PNG's radiance into 0 to 1: none (cut off), neutral (Khronos PBR Neutral), aces "
        "or agx (none)")
        ->type_name("CURVE");
    add_name(app, "--variant", options.variant, "The variant of the scene's materials to show (its own)")
        ->type_name("NAME");
    app.add_flag("--allow-outside", options.allow_outside, "Let the scene name files outside its own folder");
}

void declare_paths(CLI::App& app, Options& options) {
    add_number(app, "--max-path-length", options.max_path_length, 1, MAX_PATH_SEGMENTS,
               "Path segments from the eye; 1 shows emitters and sky only (8)")
        ->type_name("N");
    app.add_flag_callback(
        "--no-roulette", [&options] { options.russian_roulette = false; }, "No Russian roulette");
    app.add_flag_callback(
        "--no-nee", [&options] { options.next_event_estimation = false; }, "No next event estimation");
    add_parsed(
        app, "--clamp", parse_limit, [&options](float limit) { options.indirect_limit = limit; },
        "Radiance that one path of indirect light may bring at most: fewer fireflies, some light less (none)")
        ->type_name("X");
    app.add_flag("--exact", options.exact, "Checking mode: both cores give the same bits");
}

void declare_machine(CLI::App& app, Options& options) {
    add_parsed(
        app, "--core", parse_cores,
        [&options](const std::vector<std::string>& cores) {
            options.cores = cores;
            options.core_given = true;
        },
        "source (Vulkan), target (Embree) or null (black); of several, separated by commas, the first that the scene "
        "fits; auto is source,target with a GPU, else target,source (auto)")
        ->type_name("CORE,...");
    add_number(app, "--threads", options.threads, 1, MAX_THREADS, "Host threads; never changes the picture (all)")
        ->type_name("N");
    add_parsed(
        app, "--gpu-memory-limit", parse_mebibytes, [&options](uint64_t bytes) { options.gpu_memory_limit = bytes; },
        "Device memory the source core may use (its device-local heap)")
        ->type_name("MIB");
    add_name(app, "--kernels", options.kernels, "Folder of kernels to use in place of those built in")
        ->type_name("DIR");
}

void declare_scene(CLI::App& app, Options& options) {
    add_name(app, "SCENE", options.scene,
             "A .gltf, .glb, .obj or .fbx file, or the name of a built-in scene: still_life")
        ->required()
        ->type_name("");
}

/// What render, compare and bench share, after what is their own.
void declare_rendering(CLI::App& app, Options& options) {
    declare_picture(app, options);
    declare_paths(app, options);
    declare_machine(app, options);
    add_name(app, "--stats", options.stats, "Write counters and times as JSON")->type_name("FILE.json");
    declare_format(app, options);
    app.add_flag("--progress", options.progress, "Show the progress bar even where stderr is no terminal");
}

void declare_filter(CLI::App& app, Options& options, const char* usual) {
    add_choice<FilterMode>(
        app, "--filter", options.filter,
        {{"none", FilterMode::none}, {"spatial", FilterMode::spatial}, {"temporal", FilterMode::temporal}},
        fmt::format(
            "Take noise out: none, spatial (by like pixels around) or temporal (by those of earlier frames, too) ({})",
            usual))
        ->type_name("FILTER");
}

void declare_samples(CLI::App& app, Options& options, const std::string& help) {
    add_parsed(
        app, "--spp", [](const std::string& text) { return parse_number(text, 1, MAX_SAMPLES); },
        [&options](uint32_t count) {
            options.spp = {count};
            options.spp_given = true;
        },
        help)
        ->type_name("N");
}

/// What acts on image files, too.
const std::set<std::string> FOR_IMAGES = {"--output", "--limit-ssim", "--bias",  "--alpha",   "--format",
                                          "--quiet",  "--verbose",    "--color", "--progress"};

/// What `compare` was given: a scene, two image files, or two sets of them (the words after `--` are in images_b).
void settle_comparison(const CLI::App& app, Options& options) {
    if (app.remaining_size() > 0) return;  // what nobody asked for is named first
    std::vector<std::string>& a = options.images_a;
    std::vector<std::string>& b = options.images_b;
    for (const auto* names : {&a, &b}) {
        if (std::find(names->begin(), names->end(), "") != names->end())
            throw CLI::ValidationError("SCENE|A", "the name is empty; give one");
    }
    if (!options.bias && app.count("--alpha") > 0) throw CLI::ValidationError("--alpha", "is for --bias; give it too");
    if (b.empty() && a.size() == 1) {
        options.scene = a.front();
        a.clear();
        return;
    }
    if (options.bias && b.empty())
        throw CLI::ValidationError("--bias", "needs a scene, or two sets of image files: --bias A... -- B...");
    if (!options.bias && a.size() != 2)
        throw CLI::ValidationError(
            "SCENE|A", "a scene, two image files, or --bias A... -- B...; not " + std::to_string(a.size()) + " files");
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_lnames().empty() ? "" : "--" + option->get_lnames().front();
        if (option->count() > 0 && !name.empty() && !FOR_IMAGES.contains(name))
            throw CLI::ValidationError(name, "is for rendering a scene; image files are compared as they are");
    }
    if (!options.bias) {
        b = {a.back()};
        a.pop_back();
    }
}

/// Which samples render takes, when it stops, and what it keeps on the way.
void declare_sampling(CLI::App& app, SamplingOptions& sampling) {
    add_parsed(
        app, "--samples", parse_sample_range,
        [&sampling](const std::array<uint32_t, 2>& range) { sampling.range = range; },
        "Only samples A to B - 1, in place of --spp; as .exr, pathtracer merge adds such pictures")
        ->type_name("A:B")
        ->excludes("--spp");
    add_parsed(
        app, "--checkpoint", parse_duration, [&sampling](double seconds) { sampling.checkpoint = seconds; },
        "How often FILE.checkpoint is written, from which --resume goes on: 90s, 5m, 2h (never); with --frames only "
        "for --filter temporal")
        ->type_name("TIME");
    add_parsed(
        app, "--time-limit", parse_duration, [&sampling](double seconds) { sampling.time_limit = seconds; },
        "Stop before this has passed since the start, loading included; without --spp as many samples as fit")
        ->type_name("TIME");
    add_parsed(
        app, "--noise", parse_noise, [&sampling](double noise) { sampling.noise = noise; },
        "Stop once the mean of standard error / (mean + 0.01) is at most X; without --spp as many samples as it takes")
        ->type_name("X");
}

void declare_frames(CLI::App& app, Options& options) {
    add_parsed(
        app, "--frames", parse_frames, [&options](const FrameRange& frames) { options.frames = frames; },
        "Render a sequence: frames A to B - 1, frame n at n / fps seconds (one picture)")
        ->type_name("A:B");
    add_parsed(
        app, "--fps", parse_fps,
        [&options](double rate) {
            options.fps = rate;
            options.fps_given = true;
        },
        "Frames a second (24)")
        ->type_name("N");
    app.add_flag("--resume", options.resume,
                 "Go on from FILE.checkpoint, if there is one, to the same bits; of --frames, keep those that are "
                 "there and were "
                 "made with these options");
}

}  // namespace

void declare_common(CLI::App& app, Options& options) {
    app.add_flag("--quiet", options.quiet, "Errors only");
    app.add_flag("--verbose", options.verbose, "Say more on stderr");
    add_choice<ColorMode>(app, "--color", options.color,
                          {{"auto", ColorMode::automatic}, {"always", ColorMode::always}, {"never", ColorMode::never}},
                          "Colour on stderr: auto, always or never (auto, which respects NO_COLOR)")
        ->type_name("WHEN");
    app.set_version_flag("--version", "pathtracer " PORTTOOL_VERSION, "Print the version");
}

void declare_render(CLI::App& app, Options& options) {
    declare_scene(app, options);
    add_name(app, "-o,--output", options.output,
             "The picture, .png or .exr (<scene>.png in this folder); of several with #### for the number of the frame "
             "(<scene>_####.png)")
        ->type_name("FILE");
    declare_samples(app, options, "Samples per pixel (16)");
    declare_sampling(app, options.sampling);
    declare_filter(app, options, "none");
    declare_frames(app, options);
    declare_rendering(app, options);
}

void declare_merge(CLI::App& app, Options& options) {
    app.add_option("FILE.exr", options.inputs, "Renders of disjoint samples of one picture, by render --samples A:B")
        ->required()
        ->type_name("");
    add_name(app, "-o,--output", options.output, "The picture of all their samples, .exr or .png")
        ->required()
        ->type_name("FILE");
    declare_format(app, options);
}

void declare_compare(CLI::App& app, Options& options) {
    app.footer(
        "SCENE renders on both cores. A B are two image files; --bias A... -- B... two sets of independent renders.");
    app.add_option("SCENE|A", options.images_a,
                   "A scene as for render, or image files of any program: .exr, .png or .hdr")
        ->required()
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("");
    app.parse_complete_callback([&app, &options] { settle_comparison(app, options); });
    add_name(app, "-o,--output", options.output, "Folder for both pictures and their difference times 16 (none)")
        ->type_name("DIR");
    add_parsed(
        app, "--seed-target", [](const std::string& text) { return parse_number(text, 0, UINT32_MAX); },
        [&options](uint32_t seed) { options.seed_target = seed; }, "Another seed for the target core (that of --seed)")
        ->type_name("N");
    app.add_flag("--bias", options.bias,
                 "Tell bias from noise: independent pictures, the means of their tiles tested; exit with 1 where they "
                 "differ");
    add_parsed(
        app, "--alpha", parse_alpha, [&options](double alpha) { options.alpha = alpha; },
        "With --bias: how often equal means may be called different (0.001)")
        ->type_name("P");
    add_parsed(
        app, "--spp", parse_sample_counts, [&options](const std::vector<uint32_t>& counts) { options.spp = counts; },
        "Samples per pixel; several counts are separated by commas (16)")
        ->type_name("N,...");
    add_parsed(
        app, "--limit-ssim", parse_ssim, [&options](double limit) { options.limit_ssim = limit; },
        "Exit with 1 where the SSIM is below this")
        ->type_name("X");
    app.add_flag("--locate", options.locate, "Find the first segment, kernel and field in which the cores part");
    add_name(app, "--evidence", options.evidence, "With --locate: write what was found for porttool check --evidence")
        ->type_name("FILE.json");
    declare_rendering(app, options);
}

void declare_bench(CLI::App& app, Options& options) {
    declare_scene(app, options);
    add_name(app, "-o,--output", options.output, "Write the result here instead of stdout")->type_name("FILE");
    declare_samples(app, options, "Frames to time, of one sample per pixel each (16)");
    declare_rendering(app, options);
}

void declare_view(CLI::App& app, Options& options) {
    constexpr uint32_t ENOUGH_SAMPLES = 4096;
    declare_scene(app, options);
    add_name(app, "--log", options.log, "Write what happens as JSON lines")->type_name("FILE");
    add_name(app, "-o,--output", options.output,
             "Where the key P saves the picture, X its values (.exr) and K the camera (.camera.json) "
             "(<scene>_view.png in this folder)")
        ->type_name("FILE.png");
    declare_samples(app, options, "Samples per pixel after which a core rests (4096)");
    declare_filter(app, options, "temporal");
    app.preparse_callback([&options](size_t) {
        options.spp = {ENOUGH_SAMPLES};
        options.filter = FilterMode::temporal;
    });
    declare_picture(app, options);
    declare_paths(app, options);
    declare_machine(app, options);
}

void declare_info(CLI::App& app, Options& options) {
    declare_format(app, options);
    add_name(app, "-o,--output", options.output, "Write the result here instead of stdout")->type_name("FILE");
}

}  // namespace application

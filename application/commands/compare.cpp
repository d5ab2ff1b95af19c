// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "application/commands/command_steps.h"
#include "application/commands/commands.h"
#include "application/file_output.h"
#include "application/locate/in_step.h"
#include "application/locate/located.h"
#include "metrics/image/error.h"
#include "metrics/image/ssim.h"

namespace application {
namespace {

using render_system::Result;
using render_system::Status;

constexpr std::array<const char*, 2> CORES = {"source", "target"};
constexpr const char* LOCATED_PICTURE = "located.png";
constexpr int DIFFERENCE_GAIN = 16;  // one level off is invisible, sixteen are not

/// How far the two pictures of one sample count are apart.
struct Comparison {
    uint32_t spp = 0;
    double rmse = 0.0;
    std::optional<double> ssim;
    std::optional<double> psnr;
    double rmse_linear = 0.0;
    double pixels_off = 0.0;
    double identical_pixels = 0.0;
};

/// Renders the counts in rising order, each going on from the one before.
Result<CoreResult> render_on(const char* core, const Options& options, CoreSession& session) {
    CoreResult result;
    Picture picture(options.width, options.height);
    const auto choice = session.start({core}, picture);
    if (!choice.ok()) return choice.status;
    const std::set<uint32_t> counts(options.spp.begin(), options.spp.end());
    for (const uint32_t spp : counts) {
        if (Status status = session.render_up_to(spp); !status.ok()) return status;
        result.pictures.emplace(spp, picture);
    }
    result.stats = core_stats(session, options, choice->reason);
    return result;
}

/// One core after the other, which takes the scene away; or with --locate both in step.
Result<InStep> render_on_both(const Options& options, SceneSetup& setup, Console& console) {
    if (options.locate) return render_in_step(CORES, options, setup, console);
    CoreSession session(options, std::move(setup), console);
    InStep both;
    for (size_t i = 0; i < CORES.size(); ++i) {
        auto result = render_on(CORES[i], options, session);
        if (!result.ok()) return result.status;
        both.cores[i] = std::move(*result);
    }
    return both;
}

Comparison compare_pictures(uint32_t spp, const Picture& a, const Picture& b) {
    const auto levels_a = srgb_levels(a), levels_b = srgb_levels(b);
    const auto linear_a = linear_values(a), linear_b = linear_values(b);
    return {.spp = spp,
            .rmse = metrics::rmse(levels_a.view(), levels_b.view()),
            .ssim = metrics::ssim(levels_a.view(), levels_b.view()),
            .psnr = metrics::psnr(levels_a.view(), levels_b.view()),
            .rmse_linear = metrics::rmse_linear(linear_a.view(), linear_b.view()),
            .pixels_off = metrics::pixels_off(levels_a.view(), levels_b.view()),
            .identical_pixels = metrics::identical_pixels(linear_a.view(), linear_b.view())};
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json comparison_json(const Options& options, const std::vector<Comparison>& comparisons) {
    Json results = Json::array();
    for (const Comparison& c : comparisons) {
        results.push_back({{"spp", c.spp},
                           {"rmse", c.rmse},
                           {"ssim", or_null(c.ssim)},
                           {"psnr", or_null(c.psnr)},
                           {"rmse_linear", c.rmse_linear},
                           {"pixels_off", c.pixels_off},
                           {"identical_pixels", c.identical_pixels}});
    }
    return {{"scene", options.scene},
            {"size", {options.width, options.height}},
            {"seed", options.seed},
            {"exact", options.exact},
            {"results", results}};
}

std::string comparison_text(const std::vector<Comparison>& comparisons) {
    std::string text = fmt::format("{:>6}  {:>10}  {:>10}  {:>8}  {:>11}  {:>10}  {:>9}\n", "spp", "RMSE", "SSIM",
                                   "PSNR", "RMSE linear", "pixels off", "identical");
    for (const Comparison& c : comparisons) {
        const std::string ssim = c.ssim ? fmt::format("{:.7f}", *c.ssim) : "-";
        const std::string psnr = c.psnr ? fmt::format("{:.2f} dB", *c.psnr) : "-";
        text += fmt::format("{:>6}  {:>10.6f}  {:>10}  {:>8}  {:>11.3e}  {:>10.6f}  {:>8.3f}%\n", c.spp, c.rmse, ssim,
                            psnr, c.rmse_linear, c.pixels_off, c.identical_pixels * 100.0);
    }
    return text;
}

Status write_png(const Channels<uint8_t>& image, const std::filesystem::path& file) {
    const auto bytes = encode_png(image);
    return bytes.ok() ? write_file(file, *bytes) : bytes.status;
}

/// Before anything is rendered: the folder is there, or can be made, and takes files.
Status prepare_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        return Status::invalid(
            fmt::format("cannot make the folder {}: {}; give another place to write to", folder, error.message()));
    }
    return check_writable(std::filesystem::path(folder) / "source.png");
}

Status write_pictures(const std::filesystem::path& folder, uint32_t spp, const Picture& a, const Picture& b) {
    const auto levels_a = srgb_levels(a), levels_b = srgb_levels(b);
    const auto difference = difference_image(levels_a, levels_b, DIFFERENCE_GAIN);
    Status status = write_png(levels_a, folder / fmt::format("source_{}spp.png", spp));
    if (status.ok()) status = write_png(levels_b, folder / fmt::format("target_{}spp.png", spp));
    if (status.ok()) status = write_png(difference, folder / fmt::format("difference_{}spp.png", spp));
    return status;
}

/// The pictures that the evidence names, from its folder: those beneath it.
std::vector<std::string> evidence_pictures(const Options& options) {
    std::vector<std::string> pictures;
    if (options.output.empty()) return pictures;
    const auto folder = std::filesystem::absolute(options.evidence).lexically_normal().parent_path();
    const uint32_t spp = *std::max_element(options.spp.begin(), options.spp.end());
    for (const std::string& file : {std::string(LOCATED_PICTURE), fmt::format("source_{}spp.png", spp),
                                    fmt::format("target_{}spp.png", spp), fmt::format("difference_{}spp.png", spp)}) {
        const auto path = std::filesystem::absolute(std::filesystem::path(options.output) / file);
        const std::string relative = path.lexically_normal().lexically_relative(folder).generic_string();
        if (!relative.starts_with("..")) pictures.push_back(relative);
    }
    return pictures;
}

/// Adds what --locate found to the figures, and writes its picture and the evidence.
Status write_located(const Options& options, const render_system::HostScene& scene, const InStep& both,
                     Json& comparison, Console& console) {
    comparison["locate"] = located_json(both.differences, scene, options);
    Status status = Status::success();
    if (!options.output.empty()) {
        const Picture& picture = both.cores[0].pictures.rbegin()->second;
        status = write_png(located_image(both.differences, picture),
                           std::filesystem::path(options.output) / LOCATED_PICTURE);
    }
    if (!status.ok() || options.evidence.empty()) return status;
    const auto pictures = evidence_pictures(options);
    if (pictures.empty() && !options.output.empty())
        console.note("--evidence: the pictures do not lie beneath its folder, so it names none");
    return write_file(options.evidence, json_text(evidence_json(comparison, options, both.texts, pictures)));
}

Status check_compare(const Options& options, Console& console) {
    if (!options.evidence.empty()) {
        if (!options.locate) return Status::invalid("--evidence is what --locate found; give --locate too");
        if (Status status = check_writable(options.evidence); !status.ok()) return status;
    }
    if (options.core_given) console.note("--core is left aside: compare always renders on both cores");
    if (changes_colors(options)) console.note("--exposure and --tone-map are left aside: compare uses none");
    constexpr uint32_t LEAST_SIDE = 11;
    if (options.limit_ssim && std::min(options.width, options.height) < LEAST_SIDE) {
        return Status::invalid("--limit-ssim: there is no SSIM below 11 pixels; give a larger --size");
    }
    if (!options.output.empty()) {
        if (Status status = prepare_folder(options.output); !status.ok()) return status;
    }
    return check_files(options, options.output);
}

bool passes(const std::vector<Comparison>& comparisons, const std::optional<double>& limit) {
    return !limit || std::all_of(comparisons.begin(), comparisons.end(),
                                 [&](const Comparison& c) { return c.ssim && *c.ssim >= *limit; });
}

}  // namespace

ExitCode run_compare(const Options& options, Console& console) {
    if (Status status = check_compare(options, console); !status.ok()) return fail(console, status);
    auto setup = set_up_scene(options, console);
    if (!setup.ok()) return fail(console, setup.status);
    const auto both = render_on_both(options, *setup, console);
    if (!both.ok()) return fail(console, both.status);

    std::vector<Comparison> comparisons;
    for (const uint32_t spp : options.spp) {
        const Picture& a = both->cores[0].pictures.at(spp);
        const Picture& b = both->cores[1].pictures.at(spp);
        comparisons.push_back(compare_pictures(spp, a, b));
        if (options.output.empty()) continue;
        if (Status status = write_pictures(options.output, spp, a, b); !status.ok()) return fail(console, status);
    }
    const Json stats = {{CORES[0], both->cores[0].stats}, {CORES[1], both->cores[1].stats}};
    if (Status status = write_stats(options, stats); !status.ok()) return fail(console, status);
    Json figures = comparison_json(options, comparisons);
    if (options.locate) {
        if (Status status = write_located(options, setup->scene, *both, figures, console); !status.ok())
            return fail(console, status);
    }
    // The folder takes the pictures; the figures are the result and go to stdout all the same.
    if (options.format == Format::json)
        console.result(json_text(figures));
    else
        console.result(comparison_text(comparisons) + (options.locate ? located_text(figures["locate"]) : ""));
    return passes(comparisons, options.limit_ssim) ? DONE : ANSWER_NO;
}

}  // namespace application

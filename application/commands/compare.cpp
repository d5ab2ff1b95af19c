// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "application/bias/batches.h"
#include "application/commands/command_steps.h"
#include "application/commands/commands.h"
#include "application/commands/compare_steps.h"
#include "application/comparison/figures.h"
#include "application/counted.h"
#include "application/file_output.h"
#include "application/locate/in_step.h"
#include "application/locate/located.h"

namespace application {
namespace {

using render_system::Result;
using render_system::Status;

constexpr std::array<const char*, 2> CORES = {"source", "target"};
constexpr const char* LOCATED_PICTURE = "located.png";

std::array<uint32_t, 2> seeds_of(const Options& options) {
    return {options.seed, options.seed_target.value_or(options.seed)};
}

/// Renders the counts in rising order, each going on from the one before.
Result<CoreResult> render_on(const char* core, uint32_t seed, const Options& options, CoreSession& session) {
    CoreResult result;
    Picture picture(options.width, options.height);
    session.set_seed(seed);
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
        auto result = render_on(CORES[i], seeds_of(options)[i], options, session);
        if (!result.ok()) return result.status;
        both.cores[i] = std::move(*result);
    }
    return both;
}

Json comparison_json(const Options& options, const std::vector<Figures>& figures) {
    return {{"scene", options.scene}, {"size", {options.width, options.height}},
            {"seed", options.seed},   {"seed_target", seeds_of(options)[1]},
            {"exact", options.exact}, {"results", figures_json(figures)}};
}

/// The names of both pictures and of their difference.
std::array<std::string, 3> picture_names(uint32_t spp) {
    return {fmt::format("source_{}spp.png", spp), fmt::format("target_{}spp.png", spp),
            fmt::format("difference_{}spp.png", spp)};
}

Status write_pictures(const std::filesystem::path& folder, uint32_t spp, const BothForms& a, const BothForms& b) {
    const auto names = picture_names(spp);
    Status status = write_png(a.levels, folder / names[0]);
    if (status.ok()) status = write_png(b.levels, folder / names[1]);
    return status.ok() ? write_png(shown_difference(a.levels, b.levels), folder / names[2]) : status;
}

/// All that -o may hold.
std::vector<std::filesystem::path> pictures_of(const Options& options) {
    std::vector<std::filesystem::path> files;
    if (options.output.empty()) return files;
    const std::filesystem::path folder = options.output;
    for (const uint32_t spp : options.spp)
        for (const std::string& name : picture_names(options.bias ? plan_batches(spp).total() : spp))
            files.push_back(folder / name);
    files.push_back(folder / LOCATED_PICTURE);
    files.push_back(folder / BIAS_PICTURE);
    return files;
}

/// A path without what another spelling of it would leave out.
std::filesystem::path whole(const std::string& name) {
    return (std::filesystem::absolute(name).lexically_normal() / "").lexically_normal();
}

std::filesystem::path folder_of(const std::string& file) {
    return whole(std::filesystem::absolute(file).lexically_normal().parent_path().string());
}

/// The pictures that the evidence names, from its folder: those beneath it.
std::vector<std::string> evidence_pictures(const Options& options) {
    std::vector<std::string> pictures;
    if (options.output.empty()) return pictures;
    const std::filesystem::path folder = folder_of(options.evidence);
    const uint32_t spp = *std::max_element(options.spp.begin(), options.spp.end());
    const auto names = picture_names(spp);
    for (const std::string& file : {std::string(LOCATED_PICTURE), names[0], names[1], names[2]}) {
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

/// Options that contradict each other, and a place for evidence that is not there.
Status check_questions(const Options& options) {
    if (!options.evidence.empty() && !options.locate)
        return Status::invalid("--evidence is what --locate found; give --locate too");
    if (options.locate && options.bias)
        return Status::invalid("--locate follows the same paths, --bias needs independent ones; ask one at a time");
    if (options.locate && options.seed_target)
        return Status::invalid("--locate follows the same paths on both cores; leave --seed-target out");
    if (options.bias && options.spp.size() > 1)
        return Status::invalid("--bias takes one count of samples; give one in --spp");
    if (options.evidence.empty()) return Status::success();
    // The folder of the pictures is made with them.
    const bool is_beside_pictures = !options.output.empty() && folder_of(options.evidence) == whole(options.output);
    return is_beside_pictures ? Status::success() : check_writable(options.evidence);
}

Status check_compare(const Options& options, Console& console) {
    if (options.core_given) console.note("--core is left aside: compare always renders on both cores");
    if (changes_colors(options)) console.note("--exposure and --tone-map are left aside: compare uses none");
    constexpr uint32_t LEAST_SIDE = 11;
    if (options.limit_ssim && std::min(options.width, options.height) < LEAST_SIDE) {
        return Status::invalid("--limit-ssim: there is no SSIM below 11 pixels; give a larger --size");
    }
    return check_files(options, options.output);
}

/// The same picture on both cores, sample count by sample count.
ExitCode compare_renders(const Options& options, SceneSetup& setup, Console& console) {
    const auto both = render_on_both(options, setup, console);
    if (!both.ok()) return fail(console, both.status, false);

    std::vector<Figures> rows;
    for (const uint32_t spp : options.spp) {
        const BothForms a = both_forms(both->cores[0].pictures.at(spp));
        const BothForms b = both_forms(both->cores[1].pictures.at(spp));
        rows.push_back(compare_pictures(spp, a, b));
        warn_of(fmt::format("{} core, {}", CORES[0], counted(spp, "sample")), odd_pixels_of(a.linear), console);
        warn_of(fmt::format("{} core, {}", CORES[1], counted(spp, "sample")), odd_pixels_of(b.linear), console);
        if (options.output.empty()) continue;
        if (Status status = write_pictures(options.output, spp, a, b); !status.ok()) return fail(console, status);
    }
    const Json stats = {{CORES[0], both->cores[0].stats}, {CORES[1], both->cores[1].stats}};
    if (Status status = write_stats(options, stats); !status.ok()) return fail(console, status);
    Json figures = comparison_json(options, rows);
    if (options.locate) {
        if (Status status = write_located(options, setup.scene, *both, figures, console); !status.ok())
            return fail(console, status);
    }
    // The folder takes the pictures; the figures are the result and go to stdout all the same.
    if (options.format == Format::json)
        console.result(json_text(figures));
    else
        console.result(figures_text(rows) + (options.locate ? located_text(figures["locate"]) : ""));
    return passes(rows, options.limit_ssim) ? DONE : ANSWER_NO;
}

/// All batches of both cores.
struct BatchesOfBoth {
    std::vector<BatchedRender> cores;
    Json stats;
};

Result<BatchesOfBoth> render_batches_on_both(const Options& options, const BatchPlan& plan, SceneSetup& setup,
                                             Console& console) {
    CoreSession session(options, std::move(setup), console);
    BatchesOfBoth both;
    for (uint32_t i = 0; i < CORES.size(); ++i) {
        Picture picture(options.width, options.height);
        const auto choice = session.start({CORES[i]}, picture);
        if (!choice.ok()) return choice.status;
        auto result = render_batches(session, picture, plan, seeds_of(options)[i], i, console);
        if (!result.ok()) return result.status;
        both.cores.push_back(std::move(*result));
        both.stats[CORES[i]] = core_stats(session, options, choice->reason);
    }
    return both;
}

/// Independent pictures of both cores, and whether their means differ.
ExitCode compare_means(const Options& options, SceneSetup& setup, Console& console) {
    const BatchPlan plan = plan_batches(options.spp.front());
    if (plan.total() != options.spp.front()) {
        console.note(fmt::format("--bias: {} samples of the {} are taken, {} batches of {}", plan.total(),
                                 options.spp.front(), plan.batches, plan.samples));
    }
    const auto both = render_batches_on_both(options, plan, setup, console);
    if (!both.ok()) return fail(console, both.status, false);
    if (Status status = write_stats(options, both->stats); !status.ok()) return fail(console, status);

    const BothForms a = both_forms(both->cores[0].picture), b = both_forms(both->cores[1].picture);
    const std::vector<Figures> rows = {compare_pictures(plan.total(), a, b)};
    BiasReport report = test_for_bias(both->cores[0].means, both->cores[1].means, options.alpha, console);
    report.name_a = CORES[0];
    report.name_b = CORES[1];
    report.unit = "samples";
    report.samples_needed = samples_of_plan(report.test.samples_needed.value_or(0) * plan.total());
    if (!options.output.empty()) {
        Status status = write_pictures(options.output, plan.total(), a, b);
        if (status.ok()) status = write_bias_map(options, report);
        if (!status.ok()) return fail(console, status);
    }
    return deliver_bias(options, comparison_json(options, rows), rows, report, console);
}

}  // namespace

ExitCode run_compare(const Options& options, Console& console) {
    if (Status status = check_questions(options); !status.ok()) return fail(console, status);
    const FolderToFill folder(options.output);
    if (!folder.status().ok()) return fail(console, folder.status());
    if (!options.images_a.empty())
        return options.bias ? compare_sets(options, console) : compare_images(options, console);
    if (Status status = check_compare(options, console); !status.ok()) return fail(console, status);
    auto setup = set_up_scene(options, console, output_files(options, pictures_of(options)));
    if (!setup.ok()) return fail(console, setup.status);
    return options.bias ? compare_means(options, *setup, console) : compare_renders(options, *setup, console);
}

}  // namespace application

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "application/commands/command_steps.h"
#include "application/commands/compare_steps.h"
#include "application/comparison/picture_file.h"

namespace application {
namespace {

using render_system::Result;
using render_system::Status;

constexpr std::array<const char*, 3> PAIR_NAMES = {"a.png", "b.png", "difference.png"};

/// a.png, b.png and their difference, in which pixels that are NaN or infinite in either are magenta.
Status write_pair(const std::string& folder, const BothForms& a, const BothForms& b, const OddPixels& odd_a,
                  const OddPixels& odd_b) {
    if (folder.empty()) return Status::success();
    const std::filesystem::path path = folder;
    Channels<uint8_t> difference = shown_difference(a.levels, b.levels);
    mark_pixels(difference, odd_a);
    mark_pixels(difference, odd_b);
    Status status = write_png(a.levels, path / PAIR_NAMES[0]);
    if (status.ok()) status = write_png(b.levels, path / PAIR_NAMES[1]);
    return status.ok() ? write_png(difference, path / PAIR_NAMES[2]) : status;
}

/// None of the files that are compared is replaced by what is written.
Status check_output(const Options& options) {
    if (options.output.empty()) return Status::success();
    std::vector<InputFile> inputs;
    for (const auto* names : {&options.images_a, &options.images_b})
        for (const std::string& name : *names) inputs.push_back({"compare", name});
    std::vector<std::filesystem::path> pictures;
    for (const char* name : PAIR_NAMES) pictures.push_back(std::filesystem::path(options.output) / name);
    if (options.bias) pictures.push_back(std::filesystem::path(options.output) / BIAS_PICTURE);
    return check_outputs(output_files(options, pictures), inputs);
}

/// No SSIM, no limit of it.
Status check_limit(const Options& options, const Figures& figures) {
    if (!options.limit_ssim || figures.ssim) return Status::success();
    return Status::invalid("--limit-ssim: there is no SSIM below 11 pixels; leave it out");
}

/// One set of pictures: their mean, and what the test needs of each.
struct PictureSet {
    metrics::TileMeans means;
    BothForms mean;
    OddPixels odd;                                  ///< of all files
    std::map<uint64_t, std::string> name_of_print;  ///< to find copies
};

uint64_t print_of(const Channels<float>& image) {
    const std::string_view bytes(reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size() * sizeof(float));
    return std::hash<std::string_view>()(bytes);
}

/// Reads the files one by one; all are held against `first`.
Result<PictureSet> read_set(const std::vector<std::string>& names, const PictureFile& first, Console& console) {
    const Channels<float>& shape = first.forms.linear;
    PictureSet set{metrics::TileMeans(metrics::sixteen_along(shape.width, shape.height)), {}, {}, {}};
    Picture mean(shape.width, shape.height);
    std::vector<double> sum(shape.rgb.size());
    for (const std::string& name : names) {
        const auto file = read_picture_file(name);
        if (!file.ok()) return file.status;
        if (Status status = check_alike(first, *file); !status.ok()) return status;
        const auto [before, is_new] = set.name_of_print.emplace(print_of(file->forms.linear), name);
        if (!is_new) {
            return Status::invalid(
                fmt::format("{} and {} are one picture, which tells nothing of the noise; "
                            "give renders with seeds of their own",
                            before->second, name));
        }
        warn_of(name, file->odd, console);
        set.odd.add(file->odd);
        set.means.add(file->forms.linear.view());
        for (size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<double>(file->forms.linear.rgb[i]);
    }
    for (size_t i = 0; i < sum.size(); ++i)
        mean.pixels[i / 3][static_cast<int>(i % 3)] = static_cast<float>(sum[i] / static_cast<double>(names.size()));
    set.mean = both_forms(mean);
    return set;
}

/// Pixels that are NaN or infinite in any file of either set; empty where there are none.
std::vector<bool> odd_in_any(const PictureSet& a, const PictureSet& b, uint32_t width) {
    std::vector<bool> odd;
    for (const auto* places : {&a.odd.nan, &a.odd.infinite, &b.odd.nan, &b.odd.infinite}) {
        if (!places->empty()) odd.resize(a.mean.linear.rgb.size() / metrics::CHANNELS);
        for (const PixelPlace& place : *places) odd[size_t{place[1]} * width + place[0]] = true;
    }
    return odd;
}

/// How many tiles of the grid have no other pixel than these.
size_t tiles_lost(const metrics::TileGrid& grid, const std::vector<bool>& pixels) {
    std::vector<bool> lost(grid.tiles(), true);
    for (size_t i = 0; i < pixels.size(); ++i)
        if (!pixels[i]) lost[grid.tile_of(i % grid.width, i / grid.width)] = false;
    return static_cast<size_t>(std::count(lost.begin(), lost.end(), true));
}

/// Takes the means of both sets once more, over the pixels that are numbers in all files: a pixel that one side alone
/// lacks would make its tile darker or brighter, which is no bias.
Status leave_out_odd(const Options& options, const PictureFile& first, PictureSet& a, PictureSet& b, Console& console) {
    const std::vector<bool> odd = odd_in_any(a, b, first.forms.linear.width);
    if (odd.empty()) return Status::success();
    const metrics::TileGrid grid = a.means.grid();
    const size_t lost = tiles_lost(grid, odd);
    if (lost == grid.tiles())
        return Status::invalid("--bias: no pixel is a number in all files; leave out the files that are named above");
    console.warning(
        fmt::format("left out of all files of both sets, as NaN or infinite in one: {} of the pixels{}",
                    std::count(odd.begin(), odd.end(), true),
                    lost > 0 ? fmt::format("; {} of {} tiles are compared in none", lost, grid.tiles()) : ""));
    for (const auto& [set, names] : {std::pair{&a, &options.images_a}, std::pair{&b, &options.images_b}}) {
        set->means = metrics::TileMeans(grid, odd);
        for (const std::string& name : *names) {
            const auto file = read_picture_file(name);
            if (!file.ok()) return file.status;
            if (Status status = check_alike(first, *file); !status.ok()) return status;  // it may have been replaced
            set->means.add(file->forms.linear.view());
        }
    }
    return Status::success();
}

void note_shared(const PictureSet& a, const PictureSet& b, Console& console) {
    for (const auto& [print, name] : a.name_of_print) {
        const auto other = b.name_of_print.find(print);
        if (other == b.name_of_print.end()) continue;
        console.warning(fmt::format("{} and {} are one picture; sets that share pictures look more alike than they are",
                                    name, other->second));
        return;
    }
}

Json head(const Json& a, const Json& b, const Channels<float>& shape, const OddPixels& odd_a, const OddPixels& odd_b,
          const Figures& figures) {
    Json json = {{"a", a}, {"b", b}, {"size", {shape.width, shape.height}}, {"results", figures_json({figures})}};
    add_odd_pixels(json, "a", odd_a);
    add_odd_pixels(json, "b", odd_b);
    return json;
}

}  // namespace

ExitCode compare_images(const Options& options, Console& console) {
    if (Status status = check_output(options); !status.ok()) return fail(console, status);
    const auto a = read_picture_file(options.images_a.front());
    if (!a.ok()) return fail(console, a.status);
    const auto b = read_picture_file(options.images_b.front());
    if (!b.ok()) return fail(console, b.status);
    if (Status status = check_alike(*a, *b); !status.ok()) return fail(console, status);

    const Figures figures = compare_pictures(std::nullopt, a->forms, b->forms);
    if (Status status = check_limit(options, figures); !status.ok()) return fail(console, status);
    if (Status status = write_pair(options.output, a->forms, b->forms, a->odd, b->odd); !status.ok())
        return fail(console, status);
    warn_of(a->name, a->odd, console);
    warn_of(b->name, b->odd, console);
    console.result(options.format == Format::json
                       ? json_text(head(a->name, b->name, a->forms.linear, a->odd, b->odd, figures))
                       : figures_text({figures}));
    return passes({figures}, options.limit_ssim) ? DONE : ANSWER_NO;
}

ExitCode compare_sets(const Options& options, Console& console) {
    if (Status status = check_output(options); !status.ok()) return fail(console, status);
    const auto first = read_picture_file(options.images_a.front());
    if (!first.ok()) return fail(console, first.status);
    auto a = read_set(options.images_a, *first, console);
    if (!a.ok()) return fail(console, a.status);
    auto b = read_set(options.images_b, *first, console);
    if (!b.ok()) return fail(console, b.status);
    note_shared(*a, *b, console);
    if (Status status = leave_out_odd(options, *first, *a, *b, console); !status.ok()) return fail(console, status);

    const Figures figures = compare_pictures(std::nullopt, a->mean, b->mean);
    if (Status status = check_limit(options, figures); !status.ok()) return fail(console, status);
    BiasReport report = test_for_bias(a->means, b->means, options.alpha, console);
    report.unit = "files";
    const auto more = static_cast<double>(std::max(a->means.pictures(), b->means.pictures()));
    report.samples_needed =
        std::max<uint64_t>(metrics::kFewestPictures, whole_count(report.test.samples_needed.value_or(0) * more));
    Status status = write_pair(options.output, a->mean, b->mean, a->odd, b->odd);
    if (status.ok() && !options.output.empty()) status = write_bias_map(options, report);
    if (!status.ok()) return fail(console, status);
    Json json = head(options.images_a, options.images_b, first->forms.linear, a->odd, b->odd, figures);
    return deliver_bias(options, std::move(json), {figures}, report, console);
}

}  // namespace application

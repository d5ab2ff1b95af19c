// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "application/commands/command_steps.h"
#include "application/commands/commands.h"
#include "application/counted.h"
#include "application/file_output.h"
#include "application/sampling/sum_file.h"

namespace application {
namespace {

using render_system::Result;
using render_system::Status;

/// Adds ranges to those before, in order and with neighbours joined. Fails where they overlap.
Status add_ranges(std::vector<SampleRange>& ranges, const PicturePart& part) {
    for (const SampleRange& range : part.ranges) {
        for (const SampleRange& other : ranges)
            if (range.first < other.end && other.first < range.end)
                return Status::invalid(
                    fmt::format("{}: samples {}:{} are there already; give each sample once, and no file twice",
                                part.file, std::max(range.first, other.first), std::min(range.end, other.end)));
    }
    ranges.insert(ranges.end(), part.ranges.begin(), part.ranges.end());
    std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<SampleRange> joined;
    for (const SampleRange& range : ranges) {
        if (!joined.empty() && joined.back().end == range.first)
            joined.back().end = range.end;
        else
            joined.push_back(range);
    }
    ranges = std::move(joined);
    return Status::success();
}

/// Adds a part to those before it.
Status add_part(PicturePart& whole, PicturePart part) {
    if (const std::string other = first_difference(whole.run, part.run, "is", "here"); !other.empty())
        return Status::invalid(
            fmt::format("{} and {} are of different pictures: {}; merge files that were rendered with the same options",
                        whole.file, part.file, other));
    if (Status status = add_ranges(whole.ranges, part); !status.ok()) return status;
    for (size_t i = 0; i < part.sums.pixels.size(); ++i) add_sum(whole.sums.pixels[i], part.sums.pixels[i]);
    whole.sums.samples += part.sums.samples;
    whole.exact = whole.exact && part.exact;
    return Status::success();
}

Result<PicturePart> sum_of_files(const std::vector<std::string>& files) {
    auto whole = read_part(files.front());
    for (size_t i = 1; whole.ok() && i < files.size(); ++i) {
        auto part = read_part(files[i]);
        if (!part.ok()) return part.status;
        if (Status status = add_part(*whole, std::move(*part)); !status.ok()) return status;
    }
    return whole;
}

}  // namespace

ExitCode run_merge(const Options& options, Console& console) {
    const auto kind = image_kind(options.output);
    if (!kind.ok()) return fail(console, kind.status);
    std::vector<InputFile> inputs;
    for (const std::string& file : options.inputs) inputs.push_back({"merge", file});
    if (Status status = check_outputs(output_files(options, {options.output}), inputs); !status.ok())
        return fail(console, status);
    if (Status status = check_writable(options.output); !status.ok()) return fail(console, status);
    const auto whole = sum_of_files(options.inputs);
    if (!whole.ok()) return fail(console, whole.status);
    const PictureNotes notes{whole->sums.samples, range_text(whole->ranges), whole->run.text()};
    const bool as_sums = *kind == ImageKind::exr && whole->exact;
    const auto bytes = as_sums ? encode_sums(whole->sums, notes)
                               : encode_picture(mean_picture(whole->sums), *kind, 0.0f, ToneMap::none, notes);
    const Status status = bytes.ok() ? write_file(options.output, *bytes) : bytes.status;
    if (!status.ok()) return fail(console, status);
    if (!whole->exact)
        console.note(
            "not all files hold exact sums (render --samples A:B writes them): the last bits may differ from "
            "those of one run");
    if (whole->ranges.size() > 1 || whole->ranges.front().first > 0)
        console.warning(fmt::format("samples {} only: those between are missing", notes.ranges));
    if (options.format == Format::json)
        console.result(json_text(Json{{"image", options.output},
                                      {"samples", notes.samples},
                                      {"ranges", notes.ranges},
                                      {"files", options.inputs.size()}}));
    else
        console.note(fmt::format("{}: {} per pixel of {}", options.output, counted(notes.samples, "sample"),
                                 counted(options.inputs.size(), "file")));
    return DONE;
}

}  // namespace application

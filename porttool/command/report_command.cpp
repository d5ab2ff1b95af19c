// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "porttool/command/commands.h"
#include "porttool/judge/check_project.h"
#include "porttool/measure/finding_ages.h"
#include "porttool/read/clock.h"
#include "porttool/report/portability_page.h"
#include "porttool/report/portability_text.h"
#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/suggest.h"

namespace porttool {
namespace {

/// A bar that a block's moss_percent_target must not fall below.
struct Bar {
    std::string block;
    double percent = 0;
};

/// Reads BLOCK=PERCENT; the block may hold equal signs itself.
Bar read_bar(const std::string& text) {
    const std::string start = "--fail-under " + terminal_text(text) + ": ";
    const size_t cut = text.rfind('=');
    if (cut == std::string::npos || cut == 0)
        throw CannotDo(start + "expected BLOCK=PERCENT, as in --fail-under BSDF=90");
    Bar bar{text.substr(0, cut), 0};
    std::string number = text.substr(cut + 1);
    if (number.ends_with('%')) number.pop_back();
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), bar.percent);
    constexpr double kMost = 100;
    if (error != std::errc() || end != number.data() + number.size() || !(bar.percent >= 0 && bar.percent <= kMost))
        throw CannotDo(start + "'" + terminal_text(text.substr(cut + 1)) +
                       "' is no percentage; expected a number from 0 to 100");
    return bar;
}

const BlockReport& block_of(const PortabilityReport& report, const Bar& bar) {
    if (const BlockReport* block = find_block(report.blocks, bar.block)) return *block;
    std::vector<std::string> names;
    std::string list;
    for (const BlockReport& block : report.blocks) {
        names.push_back(block.name);
        list += (list.empty() ? "" : ", ") + terminal_text(block.name);
    }
    const std::string near = terminal_text(nearest(bar.block, names));
    throw CannotDo("--fail-under " + terminal_text(bar.block) + ": no such block" +
                   (near.empty()   ? std::string()
                    : list.empty() ? std::string()
                                   : "; did you mean '" + near + "'?") +
                   "\nBlocks here: " + (list.empty() ? "none" : list));
}

/// The blocks that fall below their bars, one line each.
std::string below_bars(const PortabilityReport& report, const std::vector<Bar>& bars) {
    std::string out;
    for (const Bar& bar : bars) {
        const std::optional<double> percent = block_of(report, bar).found.target.measure.moss_percent;
        if (!percent)
            throw CannotDo("--fail-under " + terminal_text(bar.block) +
                           ": the block is too short to be measured; choose a larger one, or leave the bar out");
        if (*percent < bar.percent)
            out += fmt::format("porttool: {}: moss_percent_target is {:.2f}, below the bar of {:g}\n",
                               terminal_text(bar.block), *percent, bar.percent);
    }
    return out;
}

/// Reads FILE or FILE=MRAYS; a file may hold equal signs itself.
PlatformSpeed read_bench(const std::string& text, const Options& options, const Disk& disk) {
    std::string path = text;
    std::optional<double> limit;
    const size_t cut = text.rfind('=');
    if (cut != std::string::npos && !disk.exists(join_path(options.directory, text))) {
        path = text.substr(0, cut);
        double value = 0;
        const auto [end, error] = std::from_chars(text.data() + cut + 1, text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || !(value > 0) || !std::isfinite(value))
            throw CannotDo("--bench " + terminal_text(text) + ": '" + terminal_text(text.substr(cut + 1)) +
                           "' is no rate; expected millions of rays per second, as in --bench gpu.json=120");
        limit = value;
    }
    const FileText file = disk.read(join_path(options.directory, path), kLargestFile);
    if (!file.error.empty()) throw CannotDo("--bench " + terminal_text(path) + ": " + file.error);
    const ReadSpeed speed = read_speed(path, file.bytes, limit);
    if (!speed.error.empty()) throw CannotDo(speed.error);
    return speed.platform;
}

SideTexts read_texts(const Project& project, const Disk& disk) {
    SideTexts texts;
    const auto read = [&](Side side, const std::vector<ScannedFile>& files, const std::string& root) {
        for (const ScannedFile& file : files)
            texts[side][file.path] = disk.read(place_of_path(root, file.path), kLargestFile).bytes;
    };
    read(Side::Source, project.source, project.root);
    read(Side::Target, project.target, target_root(project));
    return texts;
}

PortabilityReport report_of(const Project& project, const Judgement& judgement, bool strict) {
    const PortabilityCase facts{project.map, project.source, project.target, judgement};
    const Blocks blocks = blocks_of(facts);
    if (strict && !blocks.error.empty()) throw CannotDo(blocks.error);
    return portability_report(facts, blocks);
}

std::string formatted(const WholeReport& whole, const Options& options, const Project& project, const Disk& disk) {
    if (options.format == "html") return portability_html(whole, read_texts(project, disk));
    if (options.format == "json") return json_text(portability_json(whole), 1) + "\n";
    if (options.format == "csv") return portability_csv(whole);
    return options.format == "markdown" ? portability_markdown(whole) : portability_table(whole);
}

}  // namespace

void declare_report(Declare& declare, Options& options) {
    declare.text("--base", options.base, "REV", "Show each figure with its change against merge-base(REV, HEAD)")
        .not_empty("a revision");
    declare.texts("--bench", options.bench, "FILE[=MRAYS]", "Speed of one platform, for performance portability")
        .one_at_a_time();
    declare
        .texts("--fail-under", options.fail_under, "BLOCK=PERCENT",
               "Exit 1 if a block's target shares less, in Moss percent")
        .one_at_a_time();
}

Outcome run_report(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "html", "markdown", "json", "csv"});
    std::vector<Bar> bars;
    for (const std::string& text : options.fail_under) bars.push_back(read_bar(text));
    Options against_lock = options;
    against_lock.base.clear();
    against_lock.lock_is_optional = true;
    const CheckedProject checked = check_project(against_lock, place);
    PortabilityReport report = report_of(checked.project, checked.judgement, true);
    if (!checked.recorded)
        for (RowReport& row : report.rows) row.state.clear();
    const std::string low = below_bars(report, bars);
    const std::string date = today();
    WholeReport whole{checked.project.map, report, checked.judgement, {}, date, {}, {}, {}, checked.recorded};
    if (checked.recorded) whole.matrix = target_matrix(checked);
    for (const std::string& text : options.bench)
        whole.performance.platforms.push_back(read_bench(text, options, place.disk));
    whole.ledger = drift_ledger(checked.judgement, checked.lock, finding_ages(checked, date), date);
    CheckedProject past;
    if (!options.base.empty()) {
        past = past_project(checked.project, options.base, place.disk);
        whole.base = BaseReport{options.base, report_of(past.project, past.judgement, false), {}};
        if (past.recorded) whole.base->drift = past.judgement.summary;
    }
    Outcome outcome{formatted(whole, options, checked.project, place.disk), low.empty() ? 0 : 1};
    place.err << low;
    return outcome;
}

}  // namespace porttool

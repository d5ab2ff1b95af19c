// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/check_command.h"

#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <ctime>

#include "porttool/judge/base_lock.h"
#include "porttool/judge/brought_in.h"
#include "porttool/judge/past_project.h"
#include "porttool/judge/resolve.h"
#include "porttool/read/git.h"
#include "porttool/report/check_report.h"
#include "porttool/report/ci_reports.h"
#include "porttool/spirv/spirv_check.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {

std::string today() {
    std::time_t now = std::time(nullptr);
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
        constexpr int64_t kYear9999 = 253402300799;
        const std::string_view text = epoch;
        int64_t seconds = -1;
        const auto read = std::from_chars(text.data(), text.data() + text.size(), seconds);
        if (read.ec != std::errc() || read.ptr != text.data() + text.size() || seconds < 0 || seconds > kYear9999)
            throw CannotDo("SOURCE_DATE_EPOCH=" + terminal_text(text) +
                           ": expected seconds since 1970 as a whole number; correct it, or unset it");
        now = static_cast<std::time_t>(seconds);
    }
    std::tm date{};
    gmtime_r(&now, &date);
    std::array<char, 16> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d", &date);
    return text.data();
}

namespace {

/// With --base the lock only adds what was accepted since: one that cannot be read is left out.
RecordedLock lock_if_readable(const Project& project, const Disk& disk, const States& states, Workplace& place) {
    if (!disk.exists(lock_path(project))) return {};
    try {
        return load_lock(project, disk, states);
    } catch (const CannotDo& problem) {
        place.err << "warning: " << problem.what() << "\nWithout it, what was accepted since the base is not known\n";
        return {};
    }
}

/// Takes the state at the merge base for what was in step. Returns what the change itself does to the gate.
std::vector<BroughtIn> hold_against_base(CheckedProject& checked, const Options& options, const MapFile& map_today,
                                         const Disk& disk, Workplace& place) {
    const BaseTree tree = base_tree(checked.project, options.base);
    if (!tree.note.empty()) place.err << tree.note << "\n";
    RecordedLock now = lock_if_readable(checked.project, disk, checked.states, place);
    const BaseRecord then = base_record(checked.project, tree, now, checked.states, place.err);
    const LockFile& in_force = options.trusted_map ? then.lock.lock : now.lock;
    BaseLock base = base_lock(checked.project, tree, then.lock.lock, in_force, checked.states);
    const GateState before{then.has_map, then.map, then.has_lock, then.lock.lock, base.suppressions};
    const GateState today{true, map_today, disk.exists(lock_path(checked.project)), now.lock, checked.suppressions};
    std::vector<BroughtIn> brought =
        brought_in(before, today, options.config.empty() ? "portmap.toml" : options.config);
    if (options.trusted_map) checked.suppressions = known_before(checked.suppressions, base.suppressions);
    checked.lock = std::move(base.lock);
    checked.texts = std::move(base.texts);
    checked.texts.merge(now.texts);
    return brought;
}

/// Without them the gate still tells that a text was edited, not how, and takes no two edits for the same.
void note_missing_texts(const Project& project, const Disk& disk, const LockFile& lock, Workplace& place) {
    const size_t missing = lock.version == 1 ? 0 : missing_texts(project, disk, lock);
    if (missing > 0)
        place.err
            << "warning: " << missing
            << " texts are missing in portmap.base/; restore it from git, or, while their pairs are in step, run: "
               "porttool accept --all\n";
}

/// A unit that was followed to where its text stands now is watched there, and no longer where it was.
void list_moved(const Judgement& judgement, std::vector<BroughtIn>& out) {
    for (const JudgedPair& pair : judgement.pairs)
        for (const auto& [unit, id] :
             {std::pair(pair.source, pair.map_source), std::pair(pair.target, pair.map_target)})
            if (unit != nullptr && unit->file != split_id(id).first)
                out.push_back({GatePart::Pair, unit->file, static_cast<int>(unit->start_line),
                               id + " is followed to " + unit->id});
}

}  // namespace

CheckedProject check_project(const Options& options, Workplace& place) {
    if (options.trusted_map && options.base.empty())
        throw CannotDo("--trusted-map takes map and lock from the merge base; name it with --base REV");
    CheckedProject checked;
    checked.project = open_project(options, place, true);
    MemoryDisk staged;
    if (options.staged) staged = staged_record(checked.project, place.disk);
    const MapFile map_today = checked.project.map;
    if (options.trusted_map) take_map_of_base(checked.project, options.base, place.disk);
    if (options.staged)
        read_staged_sides(checked.project, staged);
    else
        read_sides(checked.project, place);
    const Disk& disk = staged.exists(lock_path(checked.project)) ? staged : place.disk;  // the lock's
    checked.states = read_states(checked.project);
    checked.suppressions = placed_suppressions(checked.project);
    std::vector<BroughtIn> brought;
    if (options.base.empty()) {
        RecordedLock recorded = load_lock(checked.project, disk, checked.states);
        checked.lock = std::move(recorded.lock);
        if (checked.lock.version == 1 && options.command == "check")
            place.err
                << "note: portmap.lock is of version 1; rewrite it once, on the main branch, with: porttool accept "
                   "--all\n";
        note_missing_texts(checked.project, disk, checked.lock, place);
        checked.texts = std::move(recorded.texts);
    } else {
        brought = hold_against_base(checked, options, map_today, disk, place);
    }
    const auto text_of = [&](const std::string& print) {
        const auto found = checked.texts.find(print);
        return found == checked.texts.end() ? base_text(checked.project, disk, print) : found->second;
    };
    std::unique_ptr<SpirvCheck> spirv;
    if (options.spirv)
        spirv = std::make_unique<SpirvCheck>(checked.project, options.staged,
                                             options.base.empty() ? "HEAD" : options.base, place.disk);
    const auto same_code = [&](const UnitState& unit, bool source, const std::string& before) {
        return spirv->same_code(unit, source, before);
    };
    const Case facts{checked.project.map,
                     checked.lock,
                     checked.states.source,
                     checked.states.target,
                     checked.project.skipped,
                     text_of,
                     today(),
                     checked.suppressions,
                     spirv ? SameCode(same_code) : SameCode()};
    checked.judgement = judge(facts);
    if (!options.base.empty()) list_moved(checked.judgement, brought);
    checked.judgement.brought_in = std::move(brought);
    if (spirv)
        for (const std::string& line : spirv->obstacles()) place.err << terminal_text(line) << "\n";
    return checked;
}

namespace {

std::string formatted(const Judgement& judgement, const Project& project, const Options& options) {
    if (options.format == "json") return check_json(judgement);
    if (options.format == "junit") return check_junit(judgement);
    if (options.format == "markdown") return check_markdown(judgement);
    if (options.format == "sarif") return check_sarif(judgement, folder_in_repository(project.root));
    if (options.format == "github") return check_github(judgement, folder_in_repository(project.root));
    if (options.format == "gitlab") return check_gitlab(judgement, folder_in_repository(project.root));
    const bool terminal = isatty(STDOUT_FILENO) != 0 && options.output.empty() && std::getenv("NO_COLOR") == nullptr;
    return check_table(judgement, options.color == "always" || (options.color == "auto" && terminal));
}

}  // namespace

Outcome check_command(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json", "sarif", "junit", "github", "gitlab", "markdown"});
    const CheckedProject checked = check_project(options, place);
    const GateResult result = checked.judgement.result();
    const bool fails = result == GateResult::Drift || (result == GateResult::Review && options.strict);
    return {formatted(checked.judgement, checked.project, options), fails ? 1 : 0};
}

}  // namespace porttool

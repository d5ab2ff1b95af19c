// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/check_command.h"

#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <ctime>

#include "porttool/command/base_lock.h"
#include "porttool/command/spirv_check.h"
#include "porttool/read/git.h"
#include "porttool/report/check_report.h"
#include "porttool/report/ci_reports.h"
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
LockFile lock_if_readable(const Project& project, const Disk& disk, Workplace& place) {
    if (!disk.exists(lock_path(project))) return {};
    try {
        return load_lock(project, disk);
    } catch (const CannotDo& problem) {
        place.err << "warning: " << problem.what() << "\nWithout it, what was accepted since the base is not known\n";
        return {};
    }
}

}  // namespace

CheckedProject check_project(const Options& options, Workplace& place) {
    CheckedProject checked;
    checked.project = open_project(options, place, true);
    MemoryDisk staged;
    if (options.staged)
        staged = read_staged_sides(checked.project);
    else
        read_sides(checked.project, place);
    const Disk& disk = staged.exists(lock_path(checked.project)) ? staged : place.disk;  // the lock's
    checked.states = read_states(checked.project);
    std::map<std::string, std::string> texts;
    if (options.base.empty()) {
        checked.lock = load_lock(checked.project, disk);
    } else {
        BaseLock base =
            base_lock(checked.project, options.base, lock_if_readable(checked.project, disk, place), checked.states);
        if (!base.note.empty()) place.err << base.note << "\n";
        checked.lock = std::move(base.lock);
        texts = std::move(base.texts);
    }
    const auto text_of = [&](const std::string& print) {
        const auto found = texts.find(print);
        return found == texts.end() ? base_text(checked.project, disk, print) : found->second;
    };
    std::vector<PlacedSuppression> suppressions;
    for (const auto* side : {&checked.project.source, &checked.project.target})
        for (const ScannedFile& file : *side)
            for (const Suppression& comment : file.lexed.suppressions)
                suppressions.push_back(
                    {side == &checked.project.source ? file.path : target_path(checked.project.map, file.path),
                     comment});
    std::unique_ptr<SpirvCheck> spirv;
    if (options.spirv) spirv = std::make_unique<SpirvCheck>(checked.project, options, place.disk);
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
                     std::move(suppressions),
                     spirv ? SameCode(same_code) : SameCode()};
    checked.judgement = judge(facts);
    if (spirv)
        for (const std::string& line : spirv->obstacles()) place.err << terminal_text(line) << "\n";
    return checked;
}

namespace {

std::string formatted(const Judgement& judgement, const Project& project, const Options& options) {
    if (options.format == "json") return check_json(judgement);
    const std::string folder = folder_in_repository(project.root);
    if (options.format == "sarif") return check_sarif(judgement, folder);
    if (options.format == "junit") return check_junit(judgement);
    if (options.format == "github") return check_github(judgement, folder);
    if (options.format == "gitlab") return check_gitlab(judgement, folder);
    if (options.format == "markdown") return check_markdown(judgement);
    const bool terminal = isatty(STDOUT_FILENO) != 0 && options.output.empty() && std::getenv("NO_COLOR") == nullptr;
    return check_table(judgement, options.color == "always" || (options.color == "auto" && terminal));
}

}  // namespace

Outcome check_command(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json", "sarif", "junit", "github", "gitlab", "markdown"});
    const CheckedProject checked = check_project(options, place);
    const std::string verdict = checked.judgement.verdict();
    const bool fails = verdict == "drift" || (verdict == "review" && options.strict);
    return {formatted(checked.judgement, checked.project, options), fails ? 1 : 0};
}

}  // namespace porttool

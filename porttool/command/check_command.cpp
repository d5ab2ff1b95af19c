// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdlib>
#include <memory>

#include "porttool/command/check_cache.h"
#include "porttool/command/commands.h"
#include "porttool/judge/check_project.h"
#include "porttool/read/git_repository.h"
#include "porttool/report/check_page.h"
#include "porttool/report/check_report.h"
#include "porttool/report/ci_reports.h"
#include "porttool/spirv/spirv_check.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

bool wants_color(const Options& options) {
    const bool terminal = isatty(STDOUT_FILENO) != 0 && options.output.empty() && std::getenv("NO_COLOR") == nullptr;
    return options.color == "always" || (options.color == "auto" && terminal);
}

std::string formatted(const CheckedProject& checked, const Options& options, const Disk& disk) {
    const Judgement& judgement = checked.judgement;
    if (options.format == "json") return check_json(judgement);
    if (options.format == "junit") return check_junit(judgement);
    if (options.format == "markdown") return check_markdown(judgement);
    if (options.format == "html") return check_html(judgement, disk);
    const auto folder = [&] { return GitRepository(checked.project.root).folder(); };
    if (options.format == "sarif") return check_sarif(judgement, folder(), proposed_fixes(checked, disk));
    if (options.format == "github") return check_github(judgement, folder());
    if (options.format == "gitlab") return check_gitlab(judgement, folder());
    return check_table(judgement, wants_color(options));
}

}  // namespace

void declare_check(Declare& declare, Options& options) {
    declare.text("--base", options.base, "REV", "Hold the work tree against merge-base(REV, HEAD)")
        .not_empty("a revision");
    declare.flag("--trusted-map", options.trusted_map,
                 "With --base: take map, lock and suppressions from there, so that a change cannot settle itself");
    declare.flag("--staged", options.staged, "Take the index in place of the work tree");
    declare.flag("--spirv", options.spirv, "Compile edited GLSL; what gives the same SPIR-V is a note");
    declare.texts("--evidence", options.run_evidence, "FILE",
                  "What difftest --evidence and pathtracer compare --locate --evidence wrote: joined to the findings");
    declare.flag("--no-cache", options.no_cache,
                 "Neither use nor keep the answers that were given of the same files before");
    declare.flag("--strict", options.strict, "Exit 1 for warnings too");
}

namespace {

Outcome check(const Options& options, const std::string& repository, Workplace& place) {
    std::unique_ptr<SpirvCheck> spirv;
    const SameCodeIn same_code_in = [&](const Snapshot& snapshot) {
        spirv = std::make_unique<SpirvCheck>(snapshot, options.base.empty() ? "HEAD" : options.base, place.disk);
        return [&](const UnitState& unit, Side side, const NormalText& before) {
            return spirv->same_code(unit, side, before);
        };
    };
    const std::unique_ptr<FactsStore> kept = kept_facts(options, repository);
    CheckedProject checked =
        check_project(options, place, options.spirv ? same_code_in : SameCodeIn(), nullptr, kept.get());
    if (kept != nullptr) kept->save();
    if (checked.lock.version == 1 && options.base.empty())
        place.err << "note: portmap.lock is of version 1; rewrite it once, on the main branch, with: porttool accept "
                     "--all\n";
    if (spirv)
        for (const std::string& line : spirv->obstacles()) place.err << terminal_text(line) << "\n";
    if (options.format == "sarif" && any_fix_is_due(checked.judgement)) scan_known_files(checked);
    const GateResult result = checked.judgement.result();
    const bool fails = result == GateResult::Drift || (result == GateResult::Review && options.strict);
    return {formatted(checked, options, place.disk), fails ? 1 : 0};
}

}  // namespace

Outcome run_check(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json", "sarif", "junit", "github", "gitlab", "markdown", "html"});
    const std::string request = check_request(options, wants_color(options));
    const std::string repository =
        options.no_cache ? std::string() : outermost_repository(place.disk, options.directory);
    if (request.empty()) return check(options, repository, place);
    return through_cache(request, repository, place,
                         [&](Workplace& traced) { return check(options, repository, traced); });
}

}  // namespace porttool

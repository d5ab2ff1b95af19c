// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "porttool/command/commands.h"
#include "porttool/command/named.h"
#include "porttool/report/sync_report.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/sync/apply.h"
#include "porttool/sync/apply_journal.h"
#include "porttool/sync/verify.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// True for a pair that is out of step, also by a side that is gone, and of which nobody said that no port is due.
bool is_due(const JudgedPair& pair) {
    if (pair.standing == PairStanding::Ignored) return false;
    const bool gone = pair.unit.source == nullptr || pair.unit.target == nullptr;
    return gone ? pair.standing != PairStanding::InStep : pair.changed && !pair.equivalent;
}

/// The pairs that the command line names, by their places in the judgement; without ids those that changed.
std::vector<size_t> chosen_pairs(const Options& options, const Judgement& judgement) {
    std::vector<size_t> out;
    for (const std::string& id : options.paths) {
        const Named named = require_named(judgement, id);
        for (const JudgedPair* pair : named.pairs) out.push_back(static_cast<size_t>(pair - judgement.pairs.data()));
        if (named.pairs.empty())
            throw CannotDo(terminal_text(id) + ": no pair has this unit; porttool map lists the pairs");
    }
    if (options.paths.empty())
        for (size_t i = 0; i < judgement.pairs.size(); ++i)
            if (is_due(judgement.pairs[i])) out.push_back(i);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

/// The command that was asked for; "" for none. Throws CannotDo.
std::string verify_command(const Options& options, const CheckedProject& checked) {
    if (!options.verifies) return {};
    if (!options.verify.empty() && !named_by(checked.judgement, options.verify).pairs.empty())
        throw CannotDo("--verify takes what follows for its command, and " + terminal_text(options.verify) +
                       " is a pair; put ids before --verify");
    const std::string& command = options.verify.empty() ? checked.project.map.verify : options.verify;
    if (command.empty())
        throw CannotDo(
            "--verify names no command, and neither does portmap.toml: put verify = \"...\" into [sync], or "
            "write --verify COMMAND");
    return command;
}

/// How long it may take. Throws CannotDo.
std::chrono::milliseconds verify_limit(const Options& options) {
    const std::string text = options.verify_timeout.empty() ? "10m" : options.verify_timeout;
    const auto limit = parse_duration(text);
    if (!limit)
        throw CannotDo("--verify-timeout " + terminal_text(text) + ": expected a time above 0 such as 90s, 10m or 1h");
    return *limit;
}

void require_together(const Options& options) {
    if ((options.partial || options.force) && !options.apply)
        throw CannotDo(std::string(options.partial ? "--partial" : "--force") + " says how to --apply; add that");
    if (!options.verify_timeout.empty() && !options.verifies)
        throw CannotDo("--verify-timeout says how long --verify may take; add that");
    if (options.all && !options.paths.empty()) throw CannotDo("--all takes every pair; leave out the ids, or --all");
}

/// Runs the command on what would be written; partial proposals are tried where there is nothing else to try. None if
/// there is no command, or nothing at all to try.
std::optional<Verification> verified(const Options& options, const CheckedProject& checked, const SyncResult& result,
                                     std::vector<WrittenFile> files, Workplace& place) {
    const std::string command = verify_command(options, checked);
    const std::chrono::milliseconds limit = verify_limit(options);
    if (files.empty()) files = written_files(result.files_with_partial, checked.project);
    if (command.empty() || files.empty()) return std::nullopt;
    require_no_links(files, place.disk);
    return verify(files, command, limit, place.disk);
}

/// Writes the files, and says which. Throws CannotDo.
void write_files(const std::vector<WrittenFile>& files, const Options& options, const Project& project,
                 Workplace& place) {
    const auto brings_pairs = [](const WrittenFile& file) { return file.place.path.ends_with("portmap.lock"); };
    // The files are held against those that the proposals were made for once nobody else writes them.
    const bool guards = std::any_of(files.begin(), files.end(), brings_pairs);
    const auto guard = guards ? guard_lock(options, place) : nullptr;
    apply(files, project.root, options.force, place.disk);
    for (const WrittenFile& file : files) place.err << "wrote " << terminal_text(file.place.path) << "\n";
    if (files.empty()) place.err << "nothing to write\n";
}

}  // namespace

void declare_sync(Declare& declare, Options& options) {
    declare.texts("id", options.paths, "ID", "Id of either side, SOURCE=TARGET, or a finding's fingerprint");
    declare.flag("--all", options.all, "Every pair that is out of step, as without any id");
    declare.text("--base", options.base, "REV", "Hold against merge-base(REV, HEAD) in place of the lock")
        .not_empty("a revision");
    declare.flag("--staged", options.staged, "Take the index in place of the work tree");
    declare.choice("--to", options.to_side, {"source", "target"}, "The side that is written, whichever changed");
    declare.flag("--apply", options.apply, "Write what is proposed into the work tree: all files or none");
    declare.flag("--partial", options.partial, "With --apply: also what is certain of the others");
    declare.flag("--force", options.force, "With --apply: also over changes that are not committed");
    declare.text_or_alone(
        "--verify", options.verify, options.verifies, "CMD",
        "Run CMD, or [sync] verify of the map, on a copy with the patches; without this nothing runs");
    declare.text("--verify-timeout", options.verify_timeout, "T", "How long that may take: 90s, 5m, 1h (10m)");
}

Outcome run_sync(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json", "patch"});
    require_together(options);
    const CheckedProject checked = check_project(options, place);
    const ApplyJournal::Interrupted interrupted =
        ApplyJournal(checked.project.root, place.disk)
            .take_interrupted({checked.project.root, target_root(checked.project)});
    place.err << interrupted.told;
    if (interrupted.is_finished) return run_sync(options, place);  // of the files as they are now
    const WriteSide write = options.to_side == "source"   ? WriteSide::Source
                            : options.to_side == "target" ? WriteSide::Target
                                                          : WriteSide::Other;
    SyncResult result = propose(checked, chosen_pairs(options, checked.judgement), write, place.disk,
                                options.base.empty() ? "HEAD" : options.base);
    const std::vector<WrittenFile> files =
        written_files(options.partial ? result.files_with_partial : result.files, checked.project);
    if (options.apply) require_applicable(files, options.force, place.disk);  // before anybody waits for a command
    const std::optional<Verification> verification = verified(options, checked, result, files, place);
    const bool failed = verification && !verification->passed();
    if (failed) {
        take_back(result, *verification);
        place.err << failure_of(*verification) << (options.apply ? "; nothing was written\n" : "\n");
    } else if (options.apply) {
        write_files(files, options, checked.project, place);
    }
    const int code = result.any_left() || failed ? 1 : 0;
    const std::string written = options.apply && !failed && !files.empty() ? "the files are written" : "";
    if (options.format == "json")
        return {sync_json(result, verification), fits_json(result) ? code : 1, false, written};
    if (options.format == "patch") return {sync_patch(result), code, true, written};
    return {sync_table(result, verification), code, false, written};
}

}  // namespace porttool

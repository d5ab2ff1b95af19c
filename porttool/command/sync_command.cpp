// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "porttool/command/commands.h"
#include "porttool/command/named.h"
#include "porttool/report/sync_report.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

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
            if (judgement.pairs[i].changed && !judgement.pairs[i].equivalent) out.push_back(i);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

}  // namespace

void declare_sync(Declare& declare, Options& options) {
    declare.texts("id", options.paths, "ID", "Id of either side, SOURCE=TARGET, or a finding's fingerprint");
    declare.flag("--all", options.all, "Every pair that is out of step, as without any id");
    declare.text("--base", options.base, "REV", "Hold against merge-base(REV, HEAD) in place of the lock")
        .some_revision();
    declare.flag("--staged", options.staged, "Take the index in place of the work tree");
    declare.choice("--to", options.to_side, {"source", "target"}, "The side that is written, whichever changed");
}

Outcome run_sync(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json", "patch"});
    if (options.all && !options.paths.empty()) throw CannotDo("--all takes every pair; leave out the ids, or --all");
    const CheckedProject checked = check_project(options, place);
    const WriteSide write = options.to_side == "source"   ? WriteSide::Source
                            : options.to_side == "target" ? WriteSide::Target
                                                          : WriteSide::Other;
    const SyncResult result = propose(checked, chosen_pairs(options, checked.judgement), write, place.disk);
    const int code = result.any_left() ? 1 : 0;
    if (options.format == "json") return {sync_json(result), code};
    if (options.format == "patch") return {sync_patch(result), code};
    return {sync_table(result), code};
}

}  // namespace porttool

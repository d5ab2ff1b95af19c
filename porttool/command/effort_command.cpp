// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/commands.h"
#include "porttool/report/effort_report.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {

void declare_effort(Declare& declare, Options& options) {
    declare.text("--from", options.from, "REV", "The commit before the change").required();
    declare.text("--to", options.to, "REV", "The commit that ends it (HEAD)");
}

Outcome run_effort(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json", "csv", "toml"});
    const Past past = open_past(options, place);
    const GitCommit from = find_commit(past, "--from", options.from), to = find_commit(past, "--to", options.to);
    if (!past.git->is_ancestor(from.id, to.id))
        place.err << "porttool: " << terminal_text(options.from) << " is no ancestor of " << terminal_text(options.to)
                  << (past.git->is_shallow() ? " as far as this shallow clone tells" : "")
                  << "; the two are compared as they are, with what only the former has as removed\n";
    const RangeEffort effort = range_effort(past, from, to, place.err);
    if (options.format == "json") return {effort_json(effort), 0};
    if (options.format == "csv") return {effort_csv(effort), 0};
    if (options.format == "toml") return {effort_toml(effort), 0};
    return {effort_table(effort), 0};
}

}  // namespace porttool

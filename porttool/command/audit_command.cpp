// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <charconv>

#include "porttool/audit/audit.h"
#include "porttool/command/commands.h"
#include "porttool/report/audit_report.h"
#include "porttool/snapshot/two_sides.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

size_t most_items(const std::string& text) {
    constexpr size_t kDefault = 20;
    if (text.empty()) return kDefault;
    size_t out = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
    if (error != std::errc() || end != text.data() + text.size() || out == 0)
        throw CannotDo("--limit " + terminal_text(text) + ": expected a number from 1 on, as in --limit 50");
    return out;
}

std::string formatted_audit(const Audit& found, const std::string& format) {
    if (format == "json") return audit_json(found);
    if (format == "html") return audit_html(found);
    return format == "markdown" ? audit_markdown(found) : audit_text(found);
}

}  // namespace

void declare_audit(Declare& declare, Options& options) {
    declare_sides(declare, options);
    declare.text("--since", options.since, "REV|DATE",
                 "Read only what came after this commit, or from this day (YYYY-MM-DD) on");
    declare.text("--limit", options.limit, "N",
                 "Show at most so many items (20); from 21 on, and of at most 20 pairs, also those under 45 %");
    declare.flag("--run", options.runs,
                 "Build and run both sides of what is listed, code of the repository: an input on which they differ");
}

Outcome run_audit(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json", "html", "markdown"});
    AuditChoice choice;
    static_cast<ProjectChoice&>(choice) = options;
    choice.since = options.since;
    choice.runs = options.runs;
    choice.limit = most_items(options.limit);
    require_globs_or_map(choice, place.disk);
    const Audit found = audit(choice, place);
    if (found.shallow && !options.quiet)
        place.err << "porttool: this is a shallow clone; what its oldest commits did is not known\n"
                     "Fetch the rest: git fetch --unshallow\n";
    if (found.squashed && !options.quiet)
        place.err << "porttool: this history has a single commit; there are no edits of the past in it\n";
    else if (found.unedited && !found.shallow && !options.quiet)
        place.err << "porttool: none of the " << found.commits
                  << " commits read edited a function of either side; there are no edits of the past in them\n";
    return {formatted_audit(found, options.format), found.items.empty() ? 0 : 1};
}

}  // namespace porttool

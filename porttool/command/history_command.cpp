// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/commands.h"
#include "porttool/history/newest_blocks.h"
#include "porttool/history/timeline.h"
#include "porttool/read/blob_cache.h"
#include "porttool/read/user_cache.h"
#include "porttool/report/history_report.h"
#include "porttool/snapshot/past.h"
#include "porttool/text/date.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

constexpr uint64_t kLargestCache = 256ull * 1024 * 1024;

std::string formatted(const History& history, const std::string& format) {
    if (format == "json") return history_json(history);
    if (format == "csv") return history_csv(history);
    if (format == "html") return history_html(history);
    return history_table(history);
}

}  // namespace

void declare_history(Declare& declare, Options& options) {
    declare.text("--since", options.since, "REV|DATE",
                 "Show only what came after this commit, or from this day (YYYY-MM-DD) on");
    declare.flag("--no-cache", options.no_cache, "Neither use nor keep what was measured before");
}

Outcome run_history(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "html", "json", "csv"});
    const Past past = open_past(options, place);
    const TreePath kept{past.git->own_folder(), "porttool/history.cache", Links::None};
    const bool keeps = !options.no_cache && !this_program().empty();
    BlobCache cache;
    if (keeps)
        if (const FileText file = place.disk.read(kept, kLargestCache); file.error.empty())
            cache = BlobCache(file.bytes);
    History history = history_of(past, options.since, cache, place);
    if (options.format == "json") history.newest = newest_blocks(past, history, place.disk);
    if (keeps && cache.changed())
        if (const std::string failure = place.disk.write(kept, cache.file(kLargestCache / 2));
            !failure.empty() && options.verbose)
            place.err << "porttool: " << terminal_text(join_path(kept.root, kept.path)) << ": " << failure
                      << "; the next run measures anew\n";
    if (history.cut && !options.quiet)
        place.err << "porttool: this is a shallow clone; its history reaches back to " << history.oldest.id << " ("
                  << day_of(history.oldest.time) << ")\nFetch the rest: git fetch --unshallow\n";
    return {formatted(history, options.format), 0};
}

}  // namespace porttool

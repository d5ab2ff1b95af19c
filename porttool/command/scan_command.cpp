// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/commands.h"
#include "porttool/read/source_files.h"
#include "porttool/report/scan_report.h"
#include "porttool/scan/scan.h"
#include "porttool/snapshot/project.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {

void declare_scan(Declare& declare, Options& options) {
    declare.texts("path", options.paths, "PATH", "Files and folders").required();
}

Outcome run_scan(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json"});
    const std::string root = find_root(place.disk, options.directory);
    std::vector<std::string> paths;
    for (const std::string& path : options.paths) paths.push_back(absolute_path(join_path(options.directory, path)));
    std::vector<std::string> missing;
    const SourceSet sources = read_paths(place.disk, root, paths, missing);
    if (!missing.empty())
        throw CannotDo(terminal_text(missing.front()) +
                       ": no such file or folder; paths are relative to the working directory or -C");
    ScanReport report;
    for (const SourceText& source : sources.files) add_file(report, scan_text(source.path, source.text));
    report.skipped = sources.skipped;
    sort_report(report);
    return {options.format == "json" ? scan_json(report) : scan_table(report), 0};
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>

#include "porttool/command/commands.h"
#include "porttool/read/source_files.h"
#include "porttool/report/scan_report.h"
#include "porttool/scan/scan.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

std::string absolute(const std::string& path) {
    std::error_code error;
    return clean_path(std::filesystem::absolute(path, error).generic_string());
}

}  // namespace

Outcome scan_command(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json"});
    const std::string root = find_root(place.disk, options.directory);
    std::vector<std::string> paths;
    for (const std::string& path : options.paths) paths.push_back(absolute(join_path(options.directory, path)));
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

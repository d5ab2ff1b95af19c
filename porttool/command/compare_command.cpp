// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <future>

#include "porttool/command/commands.h"
#include "porttool/measure/measure.h"
#include "porttool/report/compare_report.h"
#include "porttool/snapshot/named_text.h"
#include "porttool/text/parallel.h"

namespace porttool {
namespace {

Excerpt excerpt_of(const NamedText& text) { return {&text.file, text.unit ? &text.file.units[*text.unit] : nullptr}; }

}  // namespace

void declare_compare(Declare& declare, Options& options) {
    declare.texts("side", options.paths, "A B", "Two files, or units as PATH:NAME").required().exactly(2);
}

Outcome run_compare(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json"});
    Project project;
    find_map(project, options, place.disk);
    load_map(project, options, place);
    const Dialect dialect(project.map.dialect);
    const auto read = [&](size_t side) {
        return read_named_text(place.disk, options.directory, project.root, options.paths.at(side));
    };
    std::future<NamedText> other = std::async(in_a_thread_if(true), read, 1);
    const NamedText a = read(0), b = other.get();
    CompareReport report{a.id(), b.id(), a.file.path, b.file.path, {}, {}};
    report.similarity = measure({excerpt_of(a)}, {excerpt_of(b)}, dialect, report.parameters);
    return {options.format == "json" ? compare_json(report) : compare_table(report), 0};
}

}  // namespace porttool

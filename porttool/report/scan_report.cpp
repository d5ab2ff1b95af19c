// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/scan_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "porttool/compare/normal_form.h"
#include "porttool/scan/scan.h"

namespace porttool {

void add_file(ScanReport& report, const ScannedFile& file) {
    auto add = [&](const Unit& unit) {
        Fingerprinter print;
        write_normal_form(file, unit, [&](std::string_view text, uint32_t) { print.add(text); });
        report.units.push_back({unit_id(file, unit), file.path, unit.name, std::string(unit_kind_name(unit.kind)),
                                std::string(language_name(file.language)), print.digits(), unit.start_line,
                                unit.end_line});
    };
    for (const Unit& unit : file.units) add(unit);
    if (file.units.empty()) add(whole_file_unit(file));
}

void sort_report(ScanReport& report) {
    std::stable_sort(report.units.begin(), report.units.end(), [](const UnitRow& a, const UnitRow& b) {
        return a.file != b.file ? a.file < b.file : a.start_line < b.start_line;
    });
    std::sort(report.skipped.begin(), report.skipped.end(),
              [](const SkippedFile& a, const SkippedFile& b) { return a.file < b.file; });
}

std::string scan_json(const ScanReport& report) {
    nlohmann::ordered_json units = nlohmann::ordered_json::array();
    for (const UnitRow& row : report.units)
        units.push_back({{"id", row.id},
                         {"file", row.file},
                         {"name", row.name},
                         {"kind", row.kind},
                         {"language", row.language},
                         {"start_line", row.start_line},
                         {"end_line", row.end_line},
                         {"fingerprint", row.fingerprint}});
    nlohmann::ordered_json skipped = nlohmann::ordered_json::array();
    for (const SkippedFile& file : report.skipped) skipped.push_back({{"file", file.file}, {"reason", file.reason}});
    const nlohmann::ordered_json out = {{"units", units}, {"skipped", skipped}};
    return out.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string scan_table(const ScanReport& report) {
    std::string out;
    for (const UnitRow& row : report.units)
        out += fmt::format("{:<9} {:>5}-{:<5} {}\n", row.kind, row.start_line, row.end_line, row.id);
    for (const SkippedFile& file : report.skipped) out += fmt::format("skipped   {}: {}\n", file.file, file.reason);
    out += fmt::format("{} units, {} files skipped\n", report.units.size(), report.skipped.size());
    return out;
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/scan_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "porttool/normal/normal_form.h"
#include "porttool/scan/scan.h"
#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

using Json = nlohmann::ordered_json;

/// Adds a list, object by object: as one document the units of a large tree take 2 KB each.
template <class Rows, class ToJson>
void add_array(std::string& out, const Rows& rows, const ToJson& to_json) {
    out += '[';
    const char* before = "\n  ";
    for (const auto& row : rows) {
        out += before;
        before = ",\n  ";
        for (const char c : json_text(to_json(row), 1)) out += c == '\n' ? std::string("\n  ") : std::string(1, c);
    }
    out += rows.empty() ? "]" : "\n ]";
}

}  // namespace

void add_file(ScanReport& report, const ScannedFile& file) {
    auto add = [&](const Unit& unit) {
        Fingerprinter print;
        write_normal_form(file, unit, [&](std::string_view text, uint32_t) { print.add(text); });
        report.units.push_back({unit_id(file, unit), file.path, unit.name, std::string(unit_kind_name(unit.kind)),
                                std::string(traits_of(file.language).name), print.digits(), unit.start_line,
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
    std::string out = "{\n \"units\": ";
    add_array(out, report.units, [](const UnitRow& row) {
        return Json{{"id", row.id},
                    {"file", row.file},
                    {"name", row.name},
                    {"kind", row.kind},
                    {"language", row.language},
                    {"start_line", row.start_line},
                    {"end_line", row.end_line},
                    {"fingerprint", row.fingerprint}};
    });
    out += ",\n \"skipped\": ";
    add_array(out, report.skipped, [](const SkippedFile& file) {
        return Json{{"file", file.file}, {"reason", file.reason}};
    });
    return out + "\n}\n";
}

std::string scan_table(const ScanReport& report) {
    std::string out;
    for (const UnitRow& row : report.units)
        out += fmt::format("{:<9} {:>5}-{:<5} {}\n", row.kind, row.start_line, row.end_line, terminal_text(row.id));
    for (const SkippedFile& file : report.skipped)
        out += fmt::format("skipped   {}: {}\n", terminal_text(file.file), terminal_text(file.reason));
    out += fmt::format("{} units, {} files skipped\n", report.units.size(), report.skipped.size());
    return out;
}

}  // namespace porttool

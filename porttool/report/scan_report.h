// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/read/source_files.h"
#include "porttool/scan/unit.h"

namespace porttool {

struct UnitRow {
    std::string id, file, name, kind, language, fingerprint;
    uint32_t start_line = 0;
    uint32_t end_line = 0;
};

/// What `porttool scan` prints.
struct ScanReport {
    std::vector<UnitRow> units;
    std::vector<SkippedFile> skipped;
};

/// Adds the units of one file; the file as a whole where it has none but has text.
void add_file(ScanReport& report, const ScannedFile& file);
void sort_report(ScanReport& report);

std::string scan_json(const ScanReport& report);
std::string scan_table(const ScanReport& report);

}  // namespace porttool

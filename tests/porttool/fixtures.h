// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "porttool/scan/scan.h"

extern "C" void __asan_init() __attribute__((weak));  // there only in what was linked under ASan

namespace porttool::testing {

/// By how much the tests that try sizes and numbers try less under ASan, with which they take ten times as long.
inline const int kLighter = __asan_init != nullptr ? 8 : 1;

/// Where the program stands that these tests were built with.
inline std::string program_folder() { return std::filesystem::canonical("/proc/self/exe").parent_path().string(); }

inline std::string read_text(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The source files of the fixture folder, without the lists of units beside them.
inline std::vector<std::filesystem::path> fixture_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(FIXTURES))
        if (entry.path().extension() != ".units") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// "kind first-last name", one line a unit.
inline std::string unit_lines(const ScannedFile& file) {
    std::ostringstream out;
    for (const Unit& unit : file.units)
        out << unit_kind_name(unit.kind) << ' ' << unit.start_line << '-' << unit.end_line << ' ' << unit.name << '\n';
    return out.str();
}

/// The same for a text alone.
inline std::string units_of(const std::string& path, const std::string& text) {
    return unit_lines(scan_text(path, text));
}

}  // namespace porttool::testing

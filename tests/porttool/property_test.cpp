// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What must hold for any text: units share no token and no line, and every line belongs to something.
#include <algorithm>

#include "porttool/language/language.h"
#include "tests/porttool/fixtures.h"

namespace porttool::testing::property_test {
namespace {

std::vector<std::filesystem::path> corpus() {
    std::vector<std::filesystem::path> files = fixture_files();
    const std::filesystem::path root = REPOSITORY;
    for (const char* folder : {"porttool", "metrics", "render_system", "source_core", "target_core", "application"}) {
        if (!std::filesystem::exists(root / folder)) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
            if (entry.is_regular_file() && language_of_path(entry.path().string()) != Language::Unknown)
                files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

TEST(ScanProperties, NoTwoUnitsShareAToken) {
    for (const auto& path : corpus()) {
        const ScannedFile file = scan_text(path.string(), read_text(path));
        std::vector<int> owner(file.lexed.tokens.size(), -1);
        for (size_t u = 0; u < file.units.size(); ++u) {
            const Unit& unit = file.units[u];
            for (uint32_t i = unit.tokens.first; i < unit.tokens.end; ++i) {
                const bool hole = std::any_of(unit.holes.begin(), unit.holes.end(),
                                              [&](const TokenRange& r) { return r.first <= i && i < r.end; });
                if (hole) continue;
                ASSERT_EQ(owner[i], -1) << path << ":" << file.lexed.tokens[i].line << " is in " << unit.name
                                        << " and in " << file.units[static_cast<size_t>(owner[i])].name;
                owner[i] = static_cast<int>(u);
            }
        }
    }
}

TEST(ScanProperties, UnitsComeInOrderAndShareALineOnlyInAClassOrWhereTheTextDoes) {
    for (const auto& path : corpus()) {
        const ScannedFile file = scan_text(path.string(), read_text(path));
        for (size_t u = 0; u < file.units.size(); ++u) {
            const Unit& unit = file.units[u];
            ASSERT_LE(unit.start_line, unit.end_line) << path << " " << unit.name;
            ASSERT_LE(unit.end_line, file.lexed.line_count) << path << " " << unit.name;
            if (u == 0) continue;
            const Unit& before = file.units[u - 1];
            const bool inner = std::any_of(before.holes.begin(), before.holes.end(), [&](const TokenRange& hole) {
                return hole.first == unit.tokens.first && hole.end == unit.tokens.end;
            });
            if (inner) {
                ASSERT_GE(unit.start_line, before.start_line) << path << " " << unit.name;
                ASSERT_LE(unit.end_line, before.end_line) << path << " " << unit.name;
            } else if (before.holes.empty()) {
                ASSERT_GE(unit.start_line, before.end_line) << path << " " << unit.name;
            }
        }
    }
}

TEST(ScanProperties, EveryLineIsInAUnitADeclarationADirectiveACommentOrBlank) {
    size_t lines = 0;
    for (const auto& path : corpus()) {
        const ScannedFile file = scan_text(path.string(), read_text(path));
        ASSERT_EQ(file.lines.size(), file.lexed.line_count);
        for (size_t i = 0; i < file.lines.size(); ++i)
            ASSERT_NE(file.lines[i], LineClass::Unclassified) << path << ":" << i + 1;
        lines += file.lines.size();
    }
    EXPECT_GT(lines, 1000u);
}

TEST(ScanProperties, TheLineCountIsThatOfTheFile) {
    for (const auto& path : corpus()) {
        const std::string text = read_text(path);
        const auto newlines = static_cast<uint32_t>(std::count(text.begin(), text.end(), '\n'));
        const uint32_t open_end = !text.empty() && text.back() != '\n' ? 1 : 0;
        EXPECT_EQ(scan_text(path.string(), text).lexed.line_count, newlines + open_end) << path;
    }
}

}  // namespace
}  // namespace porttool::testing::property_test

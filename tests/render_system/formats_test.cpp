// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// docs/formats.md says what becomes of what scenes hold; each row names a model that shows it.

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "tests/render_system/gltf_file.h"

namespace render_system::testing::formats_test {
namespace {

using ::testing::HasSubstr;

struct FormatRow {
    std::string what, state, model;
};

std::string trimmed(const std::string& text) {
    const size_t first = text.find_first_not_of(" "), last = text.find_last_not_of(" ");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// What stands between the first two backticks, else all of it.
std::string in_backticks(const std::string& text) {
    const size_t first = text.find('`');
    return first == std::string::npos ? text : text.substr(first + 1, text.find('`', first + 1) - first - 1);
}

std::vector<FormatRow> rows_of_the_page() {
    std::vector<FormatRow> rows;
    std::istringstream page(read_file(FORMATS_PAGE));
    for (std::string line; std::getline(page, line);) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, '|');) cells.push_back(trimmed(cell));
        if (cells.size() != 4 || cells[3].front() != '`') continue;
        rows.push_back({cells[1], cells[2], in_backticks(cells[3])});
    }
    return rows;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

TEST(Formats, ThePageSaysWhatBecomesOfEachModel) {
    const std::vector<FormatRow> rows = rows_of_the_page();
    EXPECT_GT(rows.size(), 30u);
    for (const FormatRow& row : rows) {
        const auto result = load_scene(FORMATS "/" + row.model);
        if (row.state == "refused") {
            ASSERT_FALSE(result.ok()) << row.model;
            EXPECT_THAT(result.status.message, HasSubstr(in_backticks(row.what)));
            continue;
        }
        ASSERT_TRUE(result.ok()) << result.status.message;
        const std::string said = joined(result->warnings);
        if (row.state == "shown")
            EXPECT_EQ(said, "") << row.model;
        else
            EXPECT_THAT(said, HasSubstr(in_backticks(row.what)));
        EXPECT_TRUE(row.state == "shown" || row.state == "left out") << row.state;
    }
}

// What the model's one texel says, in 16 bits.
TEST(Formats, AnImageOfSixteenBitsKeepsThem) {
    const auto result = load_scene(FORMATS "/sixteen_bits.gltf");
    ASSERT_TRUE(result.ok()) << result.status.message;
    EXPECT_EQ(result->scene.textures()[0].texels, (std::vector<uint32_t>{0x05231234u, 0xFFFF8001u}));
}

TEST(Formats, ThePageNamesEachModel) {
    std::set<std::string> named;
    for (const FormatRow& row : rows_of_the_page()) named.insert(row.model);
    for (const auto& entry : std::filesystem::directory_iterator(FORMATS)) {
        const std::string ending = entry.path().extension();
        if (ending != ".gltf" && ending != ".obj" && ending != ".fbx") continue;
        EXPECT_TRUE(named.contains(entry.path().filename())) << entry.path();
    }
}

}  // namespace
}  // namespace render_system::testing::formats_test

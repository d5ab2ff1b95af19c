// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The rooms of porttool/ in their order: each includes only itself and those before it (docs/porttool-inside.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>

namespace rooms_test {
namespace {

const std::vector<std::string> kRooms = {"text",     "language", "scan",   "normal", "value_graph", "read",
                                         "snapshot", "compare",  "match",  "judge",  "live",        "measure",
                                         "history",  "effort",   "spirv",  "sync",   "difftest",    "audit",
                                         "report",   "lsp",      "command"};

/// The place of a room in the order, or kRooms.size() for none.
size_t place_of(const std::string& room) {
    return static_cast<size_t>(std::find(kRooms.begin(), kRooms.end(), room) - kRooms.begin());
}

TEST(Rooms, EachIncludesOnlyThoseBeforeIt) {
    const std::filesystem::path root = std::filesystem::path(REPOSITORY) / "porttool";
    const std::regex include(R"(^\s*#include "([a-z_]+)/([a-z_]+)/)");
    size_t includes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        const std::string path = entry.path().lexically_relative(root).generic_string();
        if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
        if (path.find('/') == std::string::npos) continue;  // main.cpp
        const size_t here = place_of(path.substr(0, path.find('/')));
        ASSERT_LT(here, kRooms.size()) << path << " stands in a room that has no place in the order";
        std::ifstream file(entry.path());
        for (std::string line; std::getline(file, line);) {
            std::smatch found;
            if (!std::regex_search(line, found, include)) continue;
            ++includes;
            if (found[1] == "metrics") continue;
            EXPECT_EQ(found[1], "porttool") << path << ": " << line;
            EXPECT_LE(place_of(found[2]), here) << path << ": " << line;
        }
    }
    EXPECT_GT(includes, 300u);
}

}  // namespace
}  // namespace rooms_test

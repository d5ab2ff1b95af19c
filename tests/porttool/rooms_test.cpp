// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The rooms of porttool/ in their order: each includes only itself and those before it (docs/porttool-inside.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

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
            if (line.find("#include") == line.npos || !std::regex_search(line, found, include)) continue;
            ++includes;
            if (found[1] == "metrics") continue;
            EXPECT_EQ(found[1], "porttool") << path << ": " << line;
            EXPECT_LE(place_of(found[2]), here) << path << ": " << line;
        }
    }
    EXPECT_GT(includes, 300u);
}

/// What maps, locks, globs and commits name is opened by read/beneath, beneath the root. Files that are opened
/// otherwise have names that no repository gives: a new place among these is one to think about (docs/security.md).
TEST(Rooms, FilesOfARepositoryAreOpenedInOnePlace) {
    const std::set<std::string> kOfItsOwn = {
        "main.cpp",                      // /dev/null
        "read/beneath.cpp",              // the one place
        "read/disk.cpp",                 // the command line's own
        "read/replace_file.cpp",         // beside what it replaces, in a folder that beneath.cpp opened
        "read/write_guard.cpp",          // the same
        "read/user_cache.cpp",           // the cache
        "spirv/compile_limit.cpp",       // /proc/self
        "difftest/bounded_process.cpp",  // /proc, /dev/null
        "difftest/build.cpp",            // its own temporary folder
        "sync/verify_tree.cpp",          // the copy that it made
        "command/output_file.cpp",       // what git keeps in .git/worktrees
    };
    const std::filesystem::path root = std::filesystem::path(REPOSITORY) / "porttool";
    const std::regex opens(
        R"(\bstd::(basic_)?[io]?fstream\b|\b[fp]open\s*\(|::open(at2?)?\s*\(|\bcreat\s*\(|SYS_openat)");
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
        std::ifstream file(entry.path());
        for (std::string line; std::getline(file, line);)
            if ((line.find("open") != line.npos || line.find("stream") != line.npos ||
                 line.find("creat") != line.npos) &&
                std::regex_search(line, opens) && line.find("void ") != 0 && line.find("DriftReplay::") == line.npos)
                found.insert(entry.path().lexically_relative(root).generic_string());
    }
    EXPECT_EQ(found, kOfItsOwn);
}

}  // namespace
}  // namespace rooms_test

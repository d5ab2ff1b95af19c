// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/source_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "porttool/read/cannot_do.h"
#include "porttool/read/source_glob.h"

namespace porttool::source_files_test {
namespace {

std::vector<std::string> names(const SourceSet& set) {
    std::vector<std::string> out;
    for (const SourceText& file : set.files) out.push_back(file.path);
    return out;
}

using Names = std::vector<std::string>;

TEST(SourceFiles, FoldersAreReadByKnownSuffixAndIgnoreRules) {
    MemoryDisk disk;
    disk.files = {{"/r/a.cl", "x"},      {"/r/b.txt", "x"},           {"/r/out/c.cl", "x"},
                  {"/r/k/d.cu", "x"},    {"/r/.gitignore", "out/\n"}, {"/r/.git/e.cl", "x"},
                  {"/r/k/.cuda.cu", "x"}};
    std::vector<std::string> missing;
    EXPECT_EQ(names(read_paths(disk, "/r", {"/r"}, missing)), (Names{"a.cl", "k/.cuda.cu", "k/d.cu"}));
    EXPECT_EQ(names(read_paths(disk, "/r", {"/r/b.txt", "/r/k"}, missing)), (Names{"b.txt", "k/.cuda.cu", "k/d.cu"}));
    EXPECT_TRUE(missing.empty());
    read_paths(disk, "/r", {"/r/none.cl"}, missing);
    EXPECT_EQ(missing, Names{"/r/none.cl"});
}

TEST(SourceFiles, GlobsThatMatchNothingAreNamed) {
    MemoryDisk disk;
    disk.files = {{"/r/src/a.cl", "x"}, {"/r/src/b.inc", "x"}};
    std::vector<std::string> unmatched;
    EXPECT_EQ(names(read_globs(disk, "/r", {"src/**"}, unmatched)), Names{"src/a.cl"});
    EXPECT_EQ(names(read_globs(disk, "/r", {"src/*.inc"}, unmatched)), Names{"src/b.inc"});
    EXPECT_TRUE(unmatched.empty());
    read_globs(disk, "/r", {"lib/*.cl"}, unmatched);
    EXPECT_EQ(unmatched, Names{"lib/*.cl"});
}

// What a work tree gives for a glob, a commit gives as well.
TEST(SourceFiles, CommitsAndTheWorkTreeAreReadByOneRule) {
    MemoryDisk disk;
    const Names all = {"src/a.cl", "src/b.inc", "src/KERNEL", "src/deep/c.cu", "src/deep/README", "other/d.cl"};
    for (const std::string& path : all) disk.files["/r/" + path] = "x";
    for (const std::string glob : {"src", "src/", "./src/*", "src/**", "src/*.inc", "src/*.{inc,cl}", "src/KERNEL",
                                   "src/deep/README", "**", "."}) {
        Names taken;
        for (const std::string& path : all)
            if (SideGlobs({glob}).takes(path)) taken.push_back(path);
        std::sort(taken.begin(), taken.end());
        std::vector<std::string> unmatched;
        EXPECT_EQ(names(read_globs(disk, "/r", {glob}, unmatched)), taken) << glob;
        EXPECT_FALSE(taken.empty()) << glob;
    }
    EXPECT_TRUE(SideGlobs({"src/KERNEL"}).takes("src/KERNEL")) << "named itself, whatever its suffix";
    EXPECT_FALSE(SideGlobs({"src/*"}).takes("src/KERNEL"));
}

TEST(SourceFiles, MoreThanACheckoutHoldsIsRefused) {
    MemoryDisk disk;
    disk.files = {{"/r/a/1.cl", "12345"}, {"/r/a/2.cl", "12345"}, {"/r/a/c.txt", "x"}, {"/r/.git/d", "x"}};
    const auto error_of = [&](size_t entries, uint64_t bytes, Reach reach = Reach::Beneath) -> std::string {
        std::vector<std::string> unmatched;
        GlobScope scope{reach};
        scope.most_entries = entries;
        scope.most_bytes = bytes;
        try {
            EXPECT_EQ(read_globs(disk, "/r", {"**"}, unmatched, scope).files.size(), 2u);
            return "";
        } catch (const CannotDo& problem) {
            return problem.what();
        }
    };
    EXPECT_EQ(error_of(4, 10), "");
    EXPECT_TRUE(error_of(3, 10).starts_with("/r: more than 3 files and folders for the globs of the map"));
    EXPECT_TRUE(error_of(4, 9).starts_with("/r: more than 9 bytes of sources for the globs of the map"));
    EXPECT_EQ(error_of(1, 1, Reach::Anywhere), "") << "the user's own globs";
}

TEST(SourceFiles, WhatCannotBeReadIsSkippedWithItsReason) {
    MemoryDisk disk;
    disk.files = {{"/r/bin.cl", std::string("a\0b", 3)}, {"/r/wide.cl", "\xFF\xFEi"}, {"/r/ok.cl", "x"}};
    disk.errors = {{"/r/gone.cl", "cannot be read: No such file or directory"}};
    std::vector<std::string> missing;
    const SourceSet set = read_paths(disk, "/r", {"/r"}, missing);
    EXPECT_EQ(names(set), Names{"ok.cl"});
    ASSERT_EQ(set.skipped.size(), 3u);
    EXPECT_EQ(set.skipped[0].reason, "is binary: byte 1 is NUL");
    EXPECT_EQ(set.skipped[1].reason, "cannot be read: No such file or directory");
    EXPECT_EQ(set.skipped[2].reason, "is UTF-16; save it as UTF-8 to have it scanned");
}

TEST(SourceFiles, LoopsOfSymbolicLinksEnd) {
    const auto root = std::filesystem::temp_directory_path() / "porttool_loop_test";
    std::filesystem::remove_all(root);
    std::filesystem::create_directories(root / "a");
    std::filesystem::create_directory_symlink("..", root / "a" / "up");
    std::filesystem::create_symlink("self.cl", root / "self.cl");
    RealDisk disk;
    ASSERT_EQ(disk.write((root / "a" / "k.cl").string(), "int f() {}\n"), "");
    std::vector<std::string> missing;
    const SourceSet set = read_paths(disk, root.string(), {root.string()}, missing);
    EXPECT_EQ(names(set), Names{"a/k.cl"});
    ASSERT_EQ(set.skipped.size(), 1u);
    EXPECT_EQ(set.skipped[0].file, "self.cl");
    std::filesystem::remove_all(root);
}

}  // namespace
}  // namespace porttool::source_files_test

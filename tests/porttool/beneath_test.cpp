// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What a tree names is opened beneath its root or not at all, whoever resolves the path.
#include "porttool/read/beneath.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "porttool/read/disk.h"
#include "tests/porttool/fixtures.h"

namespace porttool::testing::beneath_test {
namespace {
namespace fs = std::filesystem;

class Beneath : public ::testing::TestWithParam<OpenBy> {
protected:
    void SetUp() override {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string("porttool_") + test->test_suite_name() + test->name();
        std::replace(name.begin(), name.end(), '/', '_');
        top = fs::temp_directory_path() / name;
        fs::remove_all(top);
        root = top / "root";
        fs::create_directories(root / "src" / "deep");
        fs::create_directories(root / ".git");
        fs::create_directories(root / "module" / ".git");
        fs::create_directories(top / "elsewhere");
        for (const char* file : {"root/src/a.cl", "root/src/deep/b.cl", "root/.git/config", "root/module/.git/config",
                                 "elsewhere/secret", "root-not/x"}) {
            fs::create_directories((top / file).parent_path());
            std::ofstream(top / file) << "text of " << file;
        }
    }
    void TearDown() override { fs::remove_all(top); }

    void link(const std::string& target, const std::string& name) const { fs::create_symlink(target, root / name); }
    OpenedBeneath open(const std::string& path, Links links = Links::Within) const {
        return open_beneath({root.string(), path, links}, O_RDONLY, GetParam());
    }
    void expect_opens(const std::string& path, const std::string& file) const {
        const OpenedBeneath got = open(path);
        ASSERT_TRUE(got.file.valid()) << path << ": " << got.error;
        struct stat opened {
        }, wanted{};
        ::fstat(got.file.get(), &opened);
        ASSERT_EQ(::stat((top / file).c_str(), &wanted), 0);
        EXPECT_EQ(opened.st_ino, wanted.st_ino) << path;
    }
    void expect_refused(const std::string& path, const std::string& why) const {
        const OpenedBeneath got = open(path);
        EXPECT_FALSE(got.file.valid()) << path;
        EXPECT_NE(got.error.find(why), std::string::npos) << path << ": " << got.error;
    }

    fs::path top, root;
};

TEST_P(Beneath, FilesAndLinksThatStayWithinAreOpened) {
    link("src/a.cl", "near.cl");
    link("../a.cl", "src/deep/up.cl");
    link("src/deep", "folder");
    link("folder", "twice");
    link((root / "src" / "a.cl").string(), "absolute.cl");
    link("../../root/src/a.cl", "src/deep/not_out.cl");  // leaves the root on its way
    expect_opens("src/a.cl", "root/src/a.cl");
    expect_opens("./src//deep/../a.cl", "root/src/a.cl");
    expect_opens("near.cl", "root/src/a.cl");
    expect_opens("src/deep/up.cl", "root/src/a.cl");
    expect_opens("folder/b.cl", "root/src/deep/b.cl");
    expect_opens("twice/up.cl", "root/src/a.cl");
    expect_opens("absolute.cl", "root/src/a.cl");
    expect_opens("", "root");
}

TEST_P(Beneath, NothingLeadsOut) {
    const std::string secret = (top / "elsewhere" / "secret").string();
    link(secret, "out.cl");
    link("../elsewhere/secret", "relative.cl");
    link("../elsewhere", "folder");
    link("out.cl", "chain.cl");
    link("../root-not/x", "prefix.cl");
    link((top / "root-not" / "x").string(), "absolute_prefix.cl");
    link("/proc/self/root" + secret, "magic.cl");
    link("../../../root/../elsewhere/secret", "src/deep/far.cl");
    for (const char* path : {"out.cl", "relative.cl", "folder/secret", "chain.cl", "prefix.cl", "absolute_prefix.cl",
                             "magic.cl", "src/deep/far.cl", "../elsewhere/secret", "src/../../elsewhere/secret", ".."})
        expect_refused(path, "leads out of " + root.string());
    expect_refused(secret, "leads out of ");
}

TEST_P(Beneath, CredentialsOfTheCheckoutAreNotRead) {
    link(".git/config", "direct.cl");
    link(".git", "folder");
    link("../.git/config", "src/up.cl");
    link("module/.git/config", "submodule.cl");
    for (const char* path : {".git/config", "src/../.git/config", "module/.git/config", "direct.cl", "folder/config",
                             "src/up.cl", "submodule.cl", ".GIT/config"})
        expect_refused(path, "lies in .git");
}

TEST_P(Beneath, WhatIsMissingOrNoFileIsSaid) {
    link("nowhere", "dangling.cl");
    link("loop.cl", "loop.cl");
    expect_refused("src/none.cl", "No such file");
    expect_refused("none/a.cl", "No such file");
    expect_refused("dangling.cl", "No such file");
    expect_refused("src/a.cl/b", "Not a directory");
    expect_refused("loop.cl", "symbolic links");
}

TEST_P(Beneath, WhereNoLinkIsFollowedEvenOneWithinIsRefused) {
    link("src/a.cl", "near.cl");
    link("src", "folder");
    EXPECT_TRUE(open("src/a.cl", Links::None).file.valid());
    for (const char* path : {"near.cl", "folder/a.cl"}) {
        const OpenedBeneath got = open(path, Links::None);
        EXPECT_FALSE(got.file.valid());
        EXPECT_NE(got.error.find("is a link"), std::string::npos) << got.error;
    }
}

TEST_P(Beneath, APipeDoesNotWait) {
    ASSERT_EQ(::mkfifo((root / "pipe.cl").c_str(), 0600), 0);
    EXPECT_TRUE(open("pipe.cl").file.valid());
    EXPECT_EQ(RealDisk().read(TreePath{root.string(), "pipe.cl"}, 100).error, "is not a regular file");
    EXPECT_EQ(RealDisk().read((root / "pipe.cl").string(), 100).error, "is not a regular file");
}

INSTANTIATE_TEST_SUITE_P(By, Beneath, ::testing::Values(OpenBy::Kernel, OpenBy::Steps),
                         [](const auto& one) { return one.param == OpenBy::Kernel ? "Kernel" : "Steps"; });

TEST(BeneathWriting, StaysBeneathToo) {
    const fs::path top = fs::temp_directory_path() / "porttool_BeneathWriting";
    fs::remove_all(top);
    fs::create_directories(top / "root" / "in");
    std::ofstream(top / "mine") << "old";
    fs::create_symlink("../mine", top / "root" / "out");
    fs::create_symlink("in/there", top / "root" / "within");
    const std::string root = (top / "root").string();
    RealDisk disk;
    EXPECT_NE(disk.write(TreePath{root, "out"}, "new").find("leads out"), std::string::npos);
    EXPECT_NE(disk.write(TreePath{root, "../mine"}, "new").find("leads out"), std::string::npos);
    EXPECT_NE(disk.remove(TreePath{root, "../mine"}), "");
    EXPECT_EQ(read_text(top / "mine"), "old");
    EXPECT_EQ(disk.write(TreePath{root, "within"}, "new"), "");
    EXPECT_EQ(read_text(top / "root" / "in" / "there"), "new") << "a link that stays within stays a link";
    EXPECT_EQ(disk.write(TreePath{root, "made/file"}, "new"), "");
    EXPECT_EQ(disk.write(TreePath{root, "out", Links::None}, "new"), "") << "the link itself is replaced";
    EXPECT_FALSE(fs::is_symlink(top / "root" / "out"));
    EXPECT_EQ(read_text(top / "mine"), "old");
    fs::remove_all(top);
}

}  // namespace
}  // namespace porttool::testing::beneath_test

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The gate against a revision and on the index, in a repository made for each test.
#include <cstdlib>

#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing {
namespace {

class Git : public ::testing::Test {
protected:
    void SetUp() override {
        if (std::system("git --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "git is not installed";
        root = std::filesystem::temp_directory_path() /
               ("porttool_git_test_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::remove_all(root);
        write("src/k.cu", source);
        write("port/k.comp", target);
        git("init -q -b main . && git config user.email a@b && git config user.name a");
        git("add -A && git commit -qm one");
        ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
        git("add -A && git commit -qm two && git branch base");
    }
    void TearDown() override { std::filesystem::remove_all(root); }

    void write(const std::string& path, const std::string& text) const {
        std::filesystem::create_directories((root / path).parent_path());
        std::ofstream(root / path) << text;
    }
    void git(const std::string& arguments) const {
        ASSERT_EQ(std::system(("cd '" + root.string() + "' && git " + arguments + " > /dev/null 2>&1").c_str()), 0)
            << arguments;
    }
    CommandRun porttool(std::vector<std::string> arguments, const std::string& folder = "") {
        arguments.insert(arguments.begin(), {"-C", folder.empty() ? root.string() : folder});
        return run(disk, arguments);
    }
    nlohmann::json check(std::vector<std::string> options, const std::string& folder = "") {
        options.insert(options.begin(), {"check", "--format", "json"});
        const CommandRun got = porttool(options, folder);
        EXPECT_NE(got.exit_code, 2) << got.err;
        return got.exit_code == 2 ? nlohmann::json() : nlohmann::json::parse(got.out);
    }

    const std::string source =
        "__device__ float shade(float a, float b) {\n  float c = a * b;\n  return c * 0.5f;\n}\n";
    const std::string target = "float shade(float a, float b) {\n  float c = a * b;\n  return c * 0.5;\n}\n";
    std::filesystem::path root;
    RealDisk disk;
};

TEST_F(Git, AgainstARevisionTheChangeItselfIsJudged) {
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
    write("src/k.cu", replaced(source, "a * b", "a + b"));
    git("commit -qam three");
    EXPECT_EQ(check({"--base", "base"})["verdict"], "drift");
    EXPECT_EQ(check({"--base", "HEAD"})["verdict"], "in_step") << "the drift is older than this base";
    EXPECT_EQ(check({})["verdict"], "drift") << "but the lock still knows it";
    write("port/k.comp", replaced(target, "a * b", "a + b"));
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
}

TEST_F(Git, ALineAcceptedSinceTheBaseCounts) {
    write("src/k.cu", replaced(source, "a * b", "a + b"));
    ASSERT_EQ(porttool({"accept", "src/k.cu:shade", "--reason", "GPU only"}).exit_code, 0);
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
    write("src/k.cu", replaced(source, "a * b", "a - b"));
    EXPECT_EQ(check({"--base", "base"})["verdict"], "drift");
}

TEST_F(Git, TheLockIsNotNeededAgainstARevision) {
    std::filesystem::remove(root / "portmap.lock");
    std::filesystem::remove_all(root / "portmap.base");
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
    write("src/k.cu", source + "__device__ int fresh(int a) { return a * 3; }\n");
    EXPECT_EQ(check({"--base", "base"})["findings"][0]["rule"], "unported");
}

TEST_F(Git, TheIndexStandsInForTheWorkTree) {
    write("src/k.cu", replaced(source, "a * b", "a + b"));
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
    git("add -A");
    write("src/k.cu", source);
    EXPECT_EQ(check({"--staged"})["verdict"], "drift");
    EXPECT_EQ(check({})["verdict"], "in_step");
}

TEST_F(Git, WorkTreesSubfoldersAndDetachedHeadsWork) {
    git("worktree add -q ../" + root.filename().string() + "_tree base");
    const std::string tree = root.string() + "_tree";
    EXPECT_EQ(check({"--base", "base"}, tree)["verdict"], "in_step");
    std::filesystem::remove_all(tree);
    git("checkout -q --detach");
    EXPECT_EQ(check({"--base", "base"}, (root / "src").string())["verdict"], "in_step");
}

TEST_F(Git, WhatGitCannotGiveIsExitCodeTwo) {
    CommandRun got = porttool({"check", "--base", "nowhere"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("git fetch origin nowhere"), std::string::npos);
    git("checkout -q --orphan other && git commit -qm alone");
    got = porttool({"check", "--base", "base"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("fetch-depth: 0"), std::string::npos) << got.err;
    std::filesystem::remove_all(root / ".git");
    got = porttool({"check", "--base", "base"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("no git repository"), std::string::npos) << got.err;
    EXPECT_EQ(got.out, "");
}

}  // namespace
}  // namespace porttool::testing

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing {

/// A git repository of its own for each test, whose commits have the days that the test says.
class TemporaryRepository : public ::testing::Test {
protected:
    void SetUp() override {
        if (std::system("git --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "git is not installed";
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        root = std::filesystem::temp_directory_path() /
               (std::string("porttool_") + test->test_suite_name() + "_" + test->name());
        std::filesystem::remove_all(root);
        std::filesystem::create_directories(root);
        git("init -q -b main . && git config user.email a@b && git config user.name a");
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
    /// Commits everything, at noon UTC of 2026-01-`day`.
    void commit(const std::string& subject, int day = 1) const {
        const std::string date = "2026-01-" + std::string(day < 10 ? "0" : "") + std::to_string(day) + "T12:00:00Z";
        const std::string set = "export GIT_AUTHOR_DATE=" + date + " GIT_COMMITTER_DATE=" + date + "; ";
        ASSERT_EQ(
            std::system((set + "cd '" + root.string() + "' && git add -A && git commit -qm '" + subject + "'").c_str()),
            0);
    }
    CommandRun porttool(std::vector<std::string> arguments, const std::string& folder = "") {
        arguments.insert(arguments.begin(), {"-C", folder.empty() ? root.string() : folder});
        return run(disk, arguments);
    }
    nlohmann::json json(std::vector<std::string> arguments, const std::string& folder = "") {
        arguments.insert(arguments.end(), {"--format", "json"});
        const CommandRun got = porttool(arguments, folder);
        EXPECT_EQ(got.exit_code, 0) << got.err;
        return got.exit_code == 0 ? nlohmann::json::parse(got.out) : nlohmann::json();
    }

    std::filesystem::path root;
    RealDisk disk;
};

}  // namespace porttool::testing

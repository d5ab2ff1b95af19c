// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/file_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace file_output_test {
namespace {

namespace fs = std::filesystem;
using application::check_writable;
using application::write_file;
using testing::HasSubstr;

class FileOutput : public testing::Test {
protected:
    FileOutput() { fs::create_directories(folder); }
    ~FileOutput() override { fs::remove_all(folder); }

    std::string content(const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        std::ostringstream text;
        text << stream.rdbuf();
        return text.str();
    }
    size_t files_in_folder() {
        return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }

    const fs::path folder = fs::temp_directory_path() / ("file_output_test." + std::to_string(getpid()) + "." +
                                                         testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(FileOutput, WritesBytesAndNothingBeside) {
    const std::string bytes("a\0b\n", 4);
    ASSERT_TRUE(write_file(folder / "a.bin", bytes).ok());
    EXPECT_EQ(content(folder / "a.bin"), bytes);
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(FileOutput, ReplacesWhatIsThere) {
    ASSERT_TRUE(write_file(folder / "a", "a long first text").ok());
    ASSERT_TRUE(write_file(folder / "a", "second").ok());
    EXPECT_EQ(content(folder / "a"), "second");
}

TEST_F(FileOutput, CheckingLeavesNothingBehind) {
    EXPECT_TRUE(check_writable(folder / "a").ok());
    EXPECT_EQ(files_in_folder(), 0u);
    ASSERT_TRUE(write_file(folder / "a", "kept").ok());
    EXPECT_TRUE(check_writable(folder / "a").ok());
    EXPECT_EQ(content(folder / "a"), "kept");
}

TEST_F(FileOutput, KeepsASymbolicLinkAndWritesBehindIt) {
    ASSERT_TRUE(write_file(folder / "real", "old").ok());
    fs::create_symlink("real", folder / "link");
    ASSERT_TRUE(write_file(folder / "link", "new").ok());
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(content(folder / "real"), "new");
}

TEST_F(FileOutput, RefusesWhatCannotBeWritten) {
    ASSERT_TRUE(write_file(folder / "file", "x").ok());
    const std::vector<std::pair<fs::path, std::string>> places = {
        {folder / "missing" / "a.png", "there is no folder"},
        {folder, "it is a folder"},
        {folder / "file" / "a.png", "cannot write"},
        {folder / std::string(300, 'n'), "cannot write"},
    };
    for (const auto& [place, reason] : places) {
        for (const auto& status : {check_writable(place), write_file(place, "y")}) {
            EXPECT_EQ(status.code, render_system::StatusCode::invalid_argument) << place;
            EXPECT_THAT(status.message, HasSubstr(place.string()));
            EXPECT_THAT(status.message, HasSubstr(reason));
        }
    }
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(FileOutput, AFullDiskIsAFailure) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
    const auto status = write_file("/dev/full", "x");
    EXPECT_FALSE(status.ok());
    EXPECT_THAT(status.message, HasSubstr("/dev/full"));
    EXPECT_TRUE(fs::is_character_file("/dev/full")) << "a device must not be replaced by a file";
}

}  // namespace
}  // namespace file_output_test

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Each fixture holds the hard cases of one dialect; the list beside it was written down by reading the file.
#include "tests/porttool/fixtures.h"

namespace porttool::testing::fixture_test {
namespace {

class Fixture : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(Fixture, HasTheUnitsThatAReaderSees) {
    const std::filesystem::path path = GetParam();
    const std::string expected = read_text(path.string() + ".units");
    ASSERT_FALSE(expected.empty()) << path << ".units is missing";
    EXPECT_EQ(units_of(path.filename().string(), read_text(path)), expected);
}

TEST_P(Fixture, ReadsTheSameWithWindowsLineEndsAndByteOrderMark) {
    const std::filesystem::path path = GetParam();
    const std::string text = read_text(path);
    std::string windows = "\xEF\xBB\xBF";
    for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(units_of(path.filename().string(), windows), units_of(path.filename().string(), text));
}

INSTANTIATE_TEST_SUITE_P(Dialects, Fixture, ::testing::ValuesIn(fixture_files()), [](const auto& instance) {
    std::string name = instance.param.filename().string();
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
});

}  // namespace
}  // namespace porttool::testing::fixture_test

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/console.h"

#include <gtest/gtest.h>

namespace console_test {
namespace {

using application::ColorMode;
using application::use_color;

TEST(Color, IsForTerminalsUnlessAskedFor) {
    EXPECT_TRUE(use_color(ColorMode::automatic, true, nullptr));
    EXPECT_FALSE(use_color(ColorMode::automatic, false, nullptr));
    EXPECT_TRUE(use_color(ColorMode::always, false, nullptr));
    EXPECT_FALSE(use_color(ColorMode::never, true, nullptr));
}

TEST(Color, RespectsNoColorUnlessAskedFor) {
    EXPECT_FALSE(use_color(ColorMode::automatic, true, "1"));
    EXPECT_TRUE(use_color(ColorMode::automatic, true, "")) << "an empty NO_COLOR counts as not set";
    EXPECT_TRUE(use_color(ColorMode::always, true, "1"));
}

TEST(Console, ShowsWhatATerminalWouldObey) {
    application::Options options;
    application::Console console(options, false, false);
    ::testing::internal::CaptureStderr();
    console.warning(
        "a.obj: \x1B[2J, \xC2\x9B"
        "31m and \xE2\x80\xAE turned\nand more");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(),
              "warning: a.obj: \\u{1b}[2J, \\u{9b}31m and \\u{202e} turned\nand more\n");
}

}  // namespace
}  // namespace console_test

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/progress_bar.h"

#include <gtest/gtest.h>

namespace progress_bar_test {
namespace {

using application::progress_line;

TEST(ProgressLine, TellsShareRateAndTimeLeft) {
    EXPECT_EQ(progress_line({"target", 8, 16, 4.24e6, 11.2}),
              "target [############------------]  50%  8/16 samples  4.2 Mrays/s  0:12 left");
    EXPECT_EQ(progress_line({"source", 0, 4, 0.0, 3725.0}),
              "source [------------------------]   0%  0/4 samples  0.0 Mrays/s  1:02:05 left");
    EXPECT_EQ(progress_line({"source", 4, 4, 1e6, 0.0}),
              "source [########################] 100%  4/4 samples  1.0 Mrays/s  0:00 left");
}

TEST(ProgressLine, NeverSaysDoneBeforeItIs) {
    EXPECT_NE(progress_line({"target", 9999, 10000, 1e6, 0.1}).find(" 99%"), std::string::npos);
}

}  // namespace
}  // namespace progress_bar_test

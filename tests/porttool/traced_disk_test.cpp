// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/traced_disk.h"

#include <gtest/gtest.h>

namespace porttool::testing {
namespace {

TEST(TracedDisk, KeepsNoTraceOfMoreThanCanBeAskedAgain) {
    MemoryDisk files;
    files.files = {{"/r/a", "text"}};
    const TracedDisk disk(files, 0);
    for (size_t i = 0; i < TracedDisk::kMostQuestions; ++i) ASSERT_TRUE(disk.exists("/r/a"));
    ASSERT_NE(disk.trace(), nullptr);
    EXPECT_EQ(disk.trace()->questions.size(), TracedDisk::kMostQuestions);
    EXPECT_TRUE(disk.exists("/r/a"));
    EXPECT_EQ(disk.trace(), nullptr);
    EXPECT_EQ(disk.read("/r/a", 10).bytes, "text");
    EXPECT_EQ(disk.trace(), nullptr);
}

}  // namespace
}  // namespace porttool::testing

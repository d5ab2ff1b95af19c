// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/text/suggest.h"

#include <gtest/gtest.h>

#include <vector>

namespace suggest_test {
namespace {

using metrics::suggest;

const std::vector<std::string> COMMANDS = {"render", "compare", "bench", "info"};

TEST(Suggest, FindsSlips) {
    EXPECT_EQ(suggest("rendr", COMMANDS), "render");
    EXPECT_EQ(suggest("redner", COMMANDS), "render");
    EXPECT_EQ(suggest("compares", COMMANDS), "compare");
    EXPECT_EQ(suggest("inof", COMMANDS), "info");
    EXPECT_EQ(suggest("banch", COMMANDS), "bench");
}

TEST(Suggest, SaysNothingWhereNothingIsNear) {
    EXPECT_EQ(suggest("watch", COMMANDS), std::nullopt);
    EXPECT_EQ(suggest("", COMMANDS), std::nullopt);
    EXPECT_EQ(suggest("x", COMMANDS), std::nullopt);
    EXPECT_EQ(suggest(std::string(5000, 'r'), COMMANDS), std::nullopt);
}

}  // namespace
}  // namespace suggest_test

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/glob.h"

#include <gtest/gtest.h>

#include "porttool/read/ignore_rules.h"

namespace porttool {
namespace {

bool matches(const char* pattern, const char* path) { return Glob(pattern).matches(path); }

TEST(Glob, StarsStayWithinAFolder) {
    EXPECT_TRUE(matches("src/*.cl", "src/a.cl"));
    EXPECT_FALSE(matches("src/*.cl", "src/b/a.cl"));
    EXPECT_TRUE(matches("s?c/a*b*.cl", "src/a1b2.cl"));
    EXPECT_FALSE(matches("*.cl", "a.cpp"));
}

TEST(Glob, DoubleStarsCrossFolders) {
    EXPECT_TRUE(matches("**/*.cl", "a.cl"));
    EXPECT_TRUE(matches("src/**/*.cl", "src/a.cl"));
    EXPECT_TRUE(matches("src/**/*.cl", "src/b/c/a.cl"));
    EXPECT_TRUE(matches("src/**", "src/b/c/a.cl"));
    EXPECT_TRUE(matches("src/**.cl", "src/b/c/a.cl"));
    EXPECT_FALSE(matches("src/**/x/*.cl", "src/b/c/a.cl"));
}

TEST(Glob, ClassesAndBraces) {
    EXPECT_TRUE(matches("a[0-9x].cl", "a7.cl"));
    EXPECT_FALSE(matches("a[!0-9].cl", "a7.cl"));
    EXPECT_TRUE(matches("{src,lib}/*.{cl,cu}", "lib/a.cu"));
    EXPECT_TRUE(matches("a{,b{1,2}}.cl", "ab2.cl"));
    EXPECT_TRUE(matches("a{,b{1,2}}.cl", "a.cl"));
    EXPECT_FALSE(matches("{src,lib}/*.{cl,cu}", "bin/a.cu"));
    EXPECT_TRUE(matches("a[.cl", "a[.cl"));
}

TEST(Glob, AFolderMeansWhatLiesInIt) {
    EXPECT_TRUE(matches("src", "src/b/a.cl"));
    EXPECT_TRUE(matches("src/", "src/b/a.cl"));
    EXPECT_TRUE(matches(".", "src/b/a.cl"));
    EXPECT_TRUE(matches("./src/*.cl", "src/a.cl"));
    EXPECT_FALSE(matches("src", "srcs/a.cl"));
}

TEST(Glob, HostilePatternsEnd) {
    EXPECT_FALSE(matches("*a*a*a*a*a*a*a*a*a*a*a*b", std::string(300, 'a').c_str()));
    EXPECT_FALSE(matches("**/**/**/**/**/**/b", "a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a"));
    EXPECT_TRUE(matches("{a,b}{a,b}{a,b}{a,b}{a,b}{a,b}", "ababab"));
}

TEST(IgnoreRules, FollowGit) {
    IgnoreRules rules;
    rules.add("", "# comment\nbuild/\n*.tmp\n!keep.tmp\n/only_here.cl\ndoc/*.txt\n");
    rules.add("sub", "local.cl\n");
    EXPECT_TRUE(rules.ignores("build", true));
    EXPECT_TRUE(rules.ignores("a/build", true));
    EXPECT_FALSE(rules.ignores("build", false));
    EXPECT_TRUE(rules.ignores("a/b.tmp", false));
    EXPECT_FALSE(rules.ignores("a/keep.tmp", false));
    EXPECT_TRUE(rules.ignores("only_here.cl", false));
    EXPECT_FALSE(rules.ignores("a/only_here.cl", false));
    EXPECT_TRUE(rules.ignores("doc/a.txt", false));
    EXPECT_FALSE(rules.ignores("x/doc/a.txt", false));
    EXPECT_TRUE(rules.ignores("sub/deep/local.cl", false));
    EXPECT_FALSE(rules.ignores("local.cl", false));
}

}  // namespace
}  // namespace porttool

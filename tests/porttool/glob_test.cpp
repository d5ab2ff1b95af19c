// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/glob.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string_view>

#include "porttool/read/id_patterns.h"
#include "porttool/read/ignore_rules.h"

namespace porttool::glob_test {
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

TEST(Glob, FoldersWithoutAMatchAreKnown) {
    const auto below = [](const char* pattern, const char* folder) { return Glob(pattern).may_match_below(folder); };
    EXPECT_TRUE(below("src/*-cuda/**", "src"));
    EXPECT_TRUE(below("src/*-cuda/**", "src/a-cuda/b/c"));
    EXPECT_FALSE(below("src/*-cuda/**", "src/a-hip"));
    EXPECT_FALSE(below("src/*-cuda/**", "lib/a-cuda"));
    EXPECT_TRUE(below("src/*.cl", "src"));
    EXPECT_FALSE(below("src/*.cl", "src/kernels"));
    EXPECT_TRUE(below("src/**/cl/*.cl", "src/a/b"));
    EXPECT_TRUE(below("src/**/**/cl/*.cl", "src/cl/cl"));
    EXPECT_TRUE(below("{src,lib}/cl", "lib/cl"));
    EXPECT_FALSE(below("{src,lib}/cl", "bin"));
    EXPECT_TRUE(below(".", "anything/at/all"));
}

// A folder is entered where, and only where, a path below it matches: by trying all short paths.
TEST(Glob, NoMatchLiesBelowAFolderThatIsNotEntered) {
    const std::vector<std::string> segments = {"a", "b", "*", "**"}, names = {"a", "b", "c"};
    std::vector<std::string> patterns = segments, paths = names;
    const auto grow = [](std::vector<std::string>& these, const std::vector<std::string>& ends, size_t longest) {
        for (size_t i = 0; i < these.size(); ++i)
            for (const std::string& end : ends)
                if (these[i].size() < longest) these.push_back(these[i] + "/" + end);
    };
    grow(patterns, segments, 5);
    grow(paths, names, 7);
    for (const std::string& text : patterns) {
        const Glob glob(text);
        for (const std::string& folder : names) {
            const bool any = std::any_of(paths.begin(), paths.end(), [&](const std::string& path) {
                return path.starts_with(folder + "/") && glob.matches(path);
            });
            EXPECT_EQ(glob.may_match_below(folder), any) << text << " below " << folder;
        }
    }
}

TEST(Glob, HostilePatternsEnd) {
    EXPECT_FALSE(matches("*a*a*a*a*a*a*a*a*a*a*a*b", std::string(300, 'a').c_str()));
    EXPECT_FALSE(matches("**/**/**/**/**/**/b", "a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a"));
    EXPECT_TRUE(matches("{a,b}{a,b}{a,b}{a,b}{a,b}{a,b}", "ababab"));
}

/// The definition: whether the rest of a pattern fits the rest of a name, for all pairs of rests, the shortest first.
bool matches_by_definition(const std::vector<std::string>& pattern, const std::string& name) {
    std::vector<std::vector<bool>> fits(pattern.size() + 1, std::vector<bool>(name.size() + 1));
    fits[pattern.size()][name.size()] = true;
    for (size_t p = pattern.size(); p-- > 0;)
        for (size_t n = name.size() + 1; n-- > 0;) {
            const bool more = n < name.size();
            if (pattern[p] == "*")
                fits[p][n] = fits[p + 1][n] || (more && fits[p][n + 1]);
            else
                fits[p][n] =
                    more && fits[p + 1][n + 1] && (pattern[p] == "?" || pattern[p].find(name[n]) != std::string::npos);
        }
    return fits[0][0];
}

TEST(Glob, GoesBackAgainAndAgainAsItIsDefined) {
    std::minstd_rand random(1);
    const std::vector<std::string> pieces = {"a", "b", "?", "*", "[ab]", "a"};
    int matched = 0;
    for (int i = 0; i < 3000; ++i) {
        std::vector<std::string> pattern = {"*"};
        for (size_t k = random() % 12; k > 0; --k) pattern.push_back(pieces[random() % pieces.size()]);
        if (i % 2 == 0) {  // goes on in the second word of places
            pattern.push_back("*");
            pattern.insert(pattern.end(), 70, "a");
            pattern.push_back("b");
        }
        std::string text, name;
        for (const std::string& piece : pattern) text += piece;
        for (size_t k = random() % 20; k > 0; --k) name += random() % 4 == 0 ? 'b' : 'a';
        name += std::string(i % 2 == 0 ? 150 + random() % 2 : 10, 'a') + (random() % 3 == 0 ? "" : "b");
        const bool wanted = matches_by_definition(pattern, name);
        matched += wanted ? 1 : 0;
        EXPECT_EQ(matches(text.c_str(), name.c_str()), wanted) << text << " " << name;
    }
    EXPECT_GT(matched, 500);
    EXPECT_LT(matched, 2500);
}

TEST(Glob, LongNamesAndPatternsWithoutAnEndAreLinear) {
    // 20,000 of them take a second and less; letter by letter they took 20 s and more.
    const std::string name = "src/" + std::string(900, 'a') + "0123.cpp",
                      pattern = "src/*" + std::string(450, 'a') + "b*";
    const Glob glob(pattern);
    for (int i = 0; i < 20'000; ++i) ASSERT_FALSE(glob.matches(name));
    EXPECT_TRUE(glob.matches(name + std::string(450, 'a') + "b"));
    EXPECT_TRUE(matches(std::string(30'000, '[').c_str(), std::string(30'000, '[').c_str()));
}

TEST(Glob, MoreThanCanBeTriedIsRefused) {
    const auto repeated = [](const char* text, size_t count) {
        std::string out;
        for (size_t i = 0; i < count; ++i) out += text;
        return out;
    };
    EXPECT_EQ(Glob(repeated("{a,b}", 11)).size(), 4096u);  // each also as a folder
    for (const std::string& pattern :
         {repeated("{a,b}", 13), repeated("{a}", 300), repeated("{a,", 40) + repeated("}", 40),
          repeated("{", 20) + "a,b" + repeated("}", 20) + repeated("{a,b,c,d,e,f,g,h}", 5), std::string(70'000, 'a'),
          repeated("{,}", 20'000)})
        EXPECT_THROW(Glob{pattern}, GlobTooLarge) << pattern.substr(0, 40);
    EXPECT_TRUE(matches(repeated("{", 50'000).c_str(), repeated("{", 50'000).c_str()));
}

TEST(IdPatterns, FindWhatEachGlobWouldFind) {
    const std::vector<std::string> texts = {"a.cu:f",  "a.cu:*",   "**/b.cu:g", "./c/*.cu:h", "c/d.cu:{k,l}",
                                            "c",       "*.cu:f#2", "c/d.cu:",   "c//d.cu:k",  "[ac].cu:f",
                                            "c/d.cu*", "\\a.cu:f", "/a.cu:f",   "c/.",        "c/d.cu:k/**"};
    const IdPatterns patterns(texts);
    for (const char* id :
         {"a.cu:f", "a.cu:f#2", "x/b.cu:g", "b.cu:g", "c/d.cu:k", "c/d.cu:h", "c/x/d.cu:k", "cc/d.cu:k"}) {
        std::vector<size_t> expected;
        for (size_t i = 0; i < texts.size(); ++i)
            if (texts[i] == id || Glob(texts[i]).matches(id)) expected.push_back(i);
        EXPECT_EQ(patterns.matching(id), expected) << id;
    }
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

TEST(IgnoreRules, TheLastOfAllKindsDecides) {
    IgnoreRules rules;
    rules.add("", "a.cu\n!*.cu\nb.cu\n/c/d.cu\n!c/*.cu\nc/e.cu\nx/\n!y/\n");
    EXPECT_FALSE(rules.ignores("a.cu", false));
    EXPECT_TRUE(rules.ignores("b.cu", false));
    EXPECT_FALSE(rules.ignores("c/d.cu", false));
    EXPECT_TRUE(rules.ignores("c/e.cu", false));
    EXPECT_TRUE(rules.ignores("c/x", true));
    EXPECT_FALSE(rules.ignores("c/x", false));
    IgnoreRules below = rules;
    below.add("c", "!e.cu\nd.cu\n");
    EXPECT_FALSE(below.ignores("c/e.cu", false));
    EXPECT_TRUE(below.ignores("c/d.cu", false));
    EXPECT_TRUE(rules.ignores("c/e.cu", false));
}

}  // namespace
}  // namespace porttool::glob_test

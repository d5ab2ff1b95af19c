// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Mutates the fixtures: whatever comes out, the scanner returns, its units are well formed, and time grows with the
// size.
#include <chrono>
#include <random>

#include "porttool/normal/unit_state.h"
#include "porttool/scan/scan.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/fuzz_inputs.h"
#include "tests/porttool/mutate.h"

namespace porttool::testing::fuzz_test {
namespace {

void expect_all_hold(FuzzKind kind, uint64_t runs) {
    for (uint64_t seed = 0; seed < runs / kLighter; ++seed)
        EXPECT_EQ(fuzz_fault(kind, fuzz_input(kind, seed), seed), "") << "seed " << seed;
}

TEST(Fuzz, WhatIsMutatedIsGood) { EXPECT_EQ(fuzz_seed_fault(), ""); }

// A few of the inputs that fuzz.sh runs by the hundred thousand.
TEST(Fuzz, Sources) { expect_all_hold(FuzzKind::Source, 250); }
TEST(Fuzz, Maps) { expect_all_hold(FuzzKind::Map, 600); }
TEST(Fuzz, Locks) { expect_all_hold(FuzzKind::Lock, 300); }
TEST(Fuzz, Bases) { expect_all_hold(FuzzKind::Base, 300); }

TEST(ScanFuzz, MutatedFilesNeverBreakTheScanner) {
    MutationStock stock;
    for (const auto& path : fixture_files()) stock.texts.push_back(read_text(path));
    stock.pieces = {"{",       "}",        "(",  ")",  "\"",   "'",          "\\\n",
                    "#if 0\n", "#endif\n", "/*", "*/", "R\"(", "template <", "\xFF"};
    const std::vector<std::string> names = {"a.cu",   "a.cl",    "a.comp",  "a.cpp",  "a.c",
                                            "a.hlsl", "a.metal", "a.slang", "a.ispc", "a.osl"};
    std::mt19937_64 random(20261121);
    for (int round = 0; round < 4000; ++round) {
        const std::string text = mutate(stock.texts[random() % stock.texts.size()], stock, random);
        ASSERT_EQ(scan_fault(scan_text(names[random() % names.size()], text)), "") << "round " << round << ":\n"
                                                                                   << text;
    }
}

TEST(ScanFuzz, RandomBytesNeverBreakTheScanner) {
    std::mt19937 random(7);
    const std::string letters = "{}()[]<>;:=,\"'\\\n#/*ab1. ~&-+";
    for (int round = 0; round < 2000; ++round) {
        std::string text;
        for (size_t i = random() % 400; i > 0; --i) text += letters[random() % letters.size()];
        ASSERT_EQ(scan_fault(scan_text("a.cpp", text)), "") << "round " << round << ":\n" << text;
    }
}

double seconds_for(const std::string& piece, size_t bytes) {
    std::string text;
    while (text.size() < bytes) text += piece;
    const auto start = std::chrono::steady_clock::now();
    const ScannedFile file = scan_text("a.cpp", text);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() +
           (file.lexed.line_count > 0 ? 0 : 1);
}

/// Texts that make careless scanners quadratic: what never closes, what nests, what almost is a name.
TEST(ScanFuzz, TimeGrowsWithTheSizeOnHostileText) {
    const std::vector<std::string> pieces = {"{",
                                             "}",
                                             "(",
                                             "a(",
                                             "<",
                                             "a<",
                                             "template<",
                                             "R\"x(",
                                             "'\\'",
                                             "\"",
                                             "/*",
                                             "#if A\n",
                                             "#if A\n{\n#else\n}\n#endif\n",
                                             "namespace a{",
                                             "struct s{",
                                             "a,",
                                             "a ",
                                             "=",
                                             ":a{}",
                                             "const a=1,",
                                             "operator",
                                             "a::",
                                             "[",
                                             "x(a):",
                                             "#define A(x) x\n",
                                             "f(a){",
                                             "M(a)",
                                             "enum{",
                                             "a(b)(c)",
                                             "const int a<",
                                             "};",
                                             "if(a)",
                                             "else "};
    for (const std::string& piece : pieces) {
        const double small = seconds_for(piece, 100'000 / kLighter);
        const double large = seconds_for(piece, 800'000 / kLighter);
        EXPECT_LT(large, 40 * small + 0.5) << "a text of " << piece;  // eight times the size; quadratic would be 64
    }
}

Print renamed_print(const std::string& text) {
    const ScannedFile file = scan_text("a.cpp", text);
    return unit_state(file, file.units.at(0)).prints.renamed;
}

/// A body of hundreds of thousands of blocks or locals, as generators write them: a step for each open block, or a
/// search through all locals, would run for hours.
TEST(ScanFuzz, RenamingIsSeenThroughInVeryDeepAndVeryLongBodies) {
    const int kMany = 150'000 / kLighter;
    auto deep = [&](const std::string& outer, const std::string& inner, const std::string& used) {
        std::string text = "void f() { int " + outer + " = 1; ";
        for (int i = 0; i < kMany; ++i) text += "{";
        text += "int " + inner + " = 2;";
        for (int i = 0; i < kMany; ++i) text += used + "++;";
        for (int i = 0; i < kMany; ++i) text += "}";
        return text + outer + "++; }";
    };
    EXPECT_EQ(renamed_print(deep("a", "b", "a")), renamed_print(deep("x", "y", "x")));
    EXPECT_NE(renamed_print(deep("a", "b", "a")), renamed_print(deep("a", "b", "b")));
    EXPECT_EQ(renamed_print(deep("a", "b", "b")), renamed_print(deep("a", "a", "a")));  // the inner one hides the outer
    auto wide = [&](const std::string& stem, int used) {
        std::string text = "void f() { ";
        for (int i = 0; i < kMany; ++i) text += "int " + stem + std::to_string(i) + " = 1, " + stem + "_;";
        return text + stem + std::to_string(used) + "++; }";
    };
    EXPECT_EQ(renamed_print(wide("a", kMany / 2)), renamed_print(wide("b", kMany / 2)));
    EXPECT_NE(renamed_print(wide("a", kMany / 2)), renamed_print(wide("a", kMany / 2 + 1)));
    auto list = [&](const std::string& last) {
        std::string text = "void f() { int a = g(";
        for (int i = 0; i < kMany; ++i) text += "1,";
        return text + "1), " + last + "; " + last + "++; }";
    };
    EXPECT_EQ(renamed_print(list("b")), renamed_print(list("c")));  // however far the next name stands
}

TEST(ScanFuzz, OneLineOfAHundredMegabytes) {
    std::string text = "int f() { return 0; } ";
    const size_t kSize = 100'000'000 / static_cast<size_t>(kLighter);
    text.reserve(kSize);
    while (text.size() < kSize - 100) text += "const float some_rather_long_name = 1234567890.0f + other_long_name; ";
    const ScannedFile file = scan_text("a.cpp", text);
    EXPECT_EQ(file.units.front().name, "f");
    EXPECT_EQ(file.lexed.line_count, 1u);
}

}  // namespace
}  // namespace porttool::testing::fuzz_test

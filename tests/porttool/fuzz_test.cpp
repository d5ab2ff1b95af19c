// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Mutates the fixtures: whatever comes out, the scanner returns, its units are well formed, and time grows with the
// size.
#include <chrono>
#include <random>

#include "porttool/compare/unit_state.h"
#include "porttool/scan/scan.h"
#include "tests/porttool/fixtures.h"

namespace porttool::testing {
namespace {

void expect_sound(const ScannedFile& file) {
    const auto tokens = static_cast<uint32_t>(file.lexed.tokens.size());
    for (const Unit& unit : file.units) {
        ASSERT_LT(unit.tokens.first, unit.tokens.end);
        ASSERT_LE(unit.tokens.end, tokens);
        ASSERT_GE(unit.start_line, 1u);
        ASSERT_LE(unit.start_line, unit.end_line);
        ASSERT_FALSE(unit.name.empty());
        const UnitState state = unit_state(file, unit);
        const std::vector<NormalToken> tokens_now = normal_form(file, unit);
        ASSERT_EQ(state.prints.written, fingerprint(tokens_now));
        ASSERT_EQ(state.tokens, tokens_now.size());
    }
    for (const LineClass line : file.lines) ASSERT_NE(line, LineClass::Unclassified);
}

std::string mutate(std::string text, const std::vector<std::string>& others, std::mt19937& random) {
    static const std::vector<std::string> kPieces = {"{",
                                                     "}",
                                                     "(",
                                                     ")",
                                                     "[",
                                                     "]",
                                                     "<",
                                                     ">",
                                                     ";",
                                                     ":",
                                                     "=",
                                                     ",",
                                                     "\"",
                                                     "'",
                                                     "\\",
                                                     "\n",
                                                     "#",
                                                     "#if 0\n",
                                                     "#else\n",
                                                     "#endif\n",
                                                     "/*",
                                                     "*/",
                                                     "//",
                                                     "R\"(",
                                                     ")\"",
                                                     "template <",
                                                     "operator",
                                                     "struct ",
                                                     "namespace a::",
                                                     "\r",
                                                     std::string(1, '\0'),
                                                     "\xFF",
                                                     "enum ",
                                                     "#define A(x) ",
                                                     "##",
                                                     "__global__ ",
                                                     "const float x = ",
                                                     "\\\n",
                                                     "::",
                                                     "~"};
    auto pick = [&](size_t n) { return std::uniform_int_distribution<size_t>(0, n)(random); };
    for (size_t edits = 1 + pick(6); edits > 0; --edits) {
        const size_t at = pick(text.size());
        switch (pick(4)) {
            case 0:
                text.insert(at, kPieces[pick(kPieces.size() - 1)]);
                break;
            case 1:
                text.erase(at, 1 + pick(40));
                break;
            case 2:
                text.resize(at);
                break;
            case 3:
                text.insert(at, text.substr(pick(text.size()), pick(200)));
                break;
            default: {
                const std::string& other = others[pick(others.size() - 1)];
                text.insert(at, other.substr(pick(other.size()), pick(300)));
            }
        }
    }
    return text;
}

TEST(ScanFuzz, MutatedFilesNeverBreakTheScanner) {
    std::vector<std::string> seeds;
    for (const auto& path : fixture_files()) seeds.push_back(read_text(path));
    const std::vector<std::string> names = {"a.cu",   "a.cl",    "a.comp",  "a.cpp", "a.c",
                                            "a.hlsl", "a.metal", "a.slang", "a.ispc"};
    std::mt19937 random(20261121);
    for (int round = 0; round < 4000; ++round) {
        std::string text = mutate(seeds[random() % seeds.size()], seeds, random);
        const ScannedFile file = scan_text(names[random() % names.size()], text);
        ASSERT_NO_FATAL_FAILURE(expect_sound(file)) << "round " << round << ":\n" << text;
    }
}

TEST(ScanFuzz, RandomBytesNeverBreakTheScanner) {
    std::mt19937 random(7);
    const std::string letters = "{}()[]<>;:=,\"'\\\n#/*ab1. ~&-+";
    for (int round = 0; round < 2000; ++round) {
        std::string text;
        for (size_t i = random() % 400; i > 0; --i) text += letters[random() % letters.size()];
        ASSERT_NO_FATAL_FAILURE(expect_sound(scan_text("a.cpp", text))) << "round " << round << ":\n" << text;
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

std::string renamed_print(const std::string& text) {
    const ScannedFile file = scan_text("a.cpp", text);
    return unit_state(file, file.units.at(0)).prints.renamed;
}

/// A body of hundreds of thousands of blocks or locals, as generators write them: a step for each open block, or a
/// search through all locals, would run for hours.
TEST(ScanFuzz, RenamingIsSeenThroughInVeryDeepAndVeryLongBodies) {
    constexpr int kMany = 150'000 / kLighter;
    auto deep = [](const std::string& outer, const std::string& inner, const std::string& used) {
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
    auto wide = [](const std::string& stem, int used) {
        std::string text = "void f() { ";
        for (int i = 0; i < kMany; ++i) text += "int " + stem + std::to_string(i) + " = 1, " + stem + "_;";
        return text + stem + std::to_string(used) + "++; }";
    };
    EXPECT_EQ(renamed_print(wide("a", kMany / 2)), renamed_print(wide("b", kMany / 2)));
    EXPECT_NE(renamed_print(wide("a", kMany / 2)), renamed_print(wide("a", kMany / 2 + 1)));
    auto list = [](const std::string& last) {
        std::string text = "void f() { int a = g(";
        for (int i = 0; i < kMany; ++i) text += "1,";
        return text + "1), " + last + "; " + last + "++; }";
    };
    EXPECT_EQ(renamed_print(list("b")), renamed_print(list("c")));  // however far the next name stands
}

TEST(ScanFuzz, OneLineOfAHundredMegabytes) {
    std::string text = "int f() { return 0; } ";
    constexpr size_t kSize = 100'000'000 / kLighter;
    text.reserve(kSize);
    while (text.size() < kSize - 100) text += "const float some_rather_long_name = 1234567890.0f + other_long_name; ";
    const ScannedFile file = scan_text("a.cpp", text);
    EXPECT_EQ(file.units.front().name, "f");
    EXPECT_EQ(file.lexed.line_count, 1u);
}

}  // namespace
}  // namespace porttool::testing

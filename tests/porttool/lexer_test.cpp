// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/lexer.h"

#include <gtest/gtest.h>

namespace porttool::lexer_test {
namespace {

std::vector<std::string> words(const std::string& text) {
    const LexedText lexed = lex(text);
    std::vector<std::string> out;
    for (const Token& token : lexed.tokens) out.emplace_back(lexed.view(token));
    return out;
}

using Words = std::vector<std::string>;

TEST(Lexer, KeepsThePlaceOfEachToken) {
    const LexedText lexed = lex("a\n  bc /* d\n */ e\n");
    ASSERT_EQ(lexed.tokens.size(), 3u);
    EXPECT_EQ(lexed.tokens[1].line, 2u);
    EXPECT_EQ(lexed.column(lexed.tokens[1]), 3u);
    EXPECT_EQ(lexed.tokens[2].line, 3u);
    EXPECT_EQ(lexed.column(lexed.tokens[2]), 5u);
    EXPECT_EQ(lexed.line_count, 3u);
}

TEST(Lexer, JoinsSplicedLinesAndStillCountsThem) {
    const LexedText lexed = lex("ab\\\ncd x\\\r\n  y\nz");
    ASSERT_EQ(lexed.tokens.size(), 4u);
    EXPECT_EQ(lexed.view(0), "abcd");
    EXPECT_EQ(lexed.tokens[1].line, 2u);
    EXPECT_EQ(lexed.tokens[2].line, 3u);
    EXPECT_EQ(lexed.column(lexed.tokens[2]), 3u);
    EXPECT_EQ(lexed.tokens[3].line, 4u);
}

TEST(Lexer, ReadsRawStringsAndWhatLooksLikeThem) {
    EXPECT_EQ(words("R\"x()\" )x\" a"), (Words{"R\"x()\" )x\"", "a"}));
    EXPECT_EQ(words("u8R\"(\n})\" a"), (Words{"u8R\"(\n})\"", "a"}));
    EXPECT_EQ(words("R\"(never closed\nb"), (Words{"R\"(never closed", "b"}));
    EXPECT_EQ(words("FOR\"a\" b"), (Words{"FOR", "\"a\"", "b"}));
}

TEST(Lexer, ReadsNumbersWhole) {
    EXPECT_EQ(words("1'000 0x1.8p-3f 1e+5 0xE+1 .5f 1.f"),
              (Words{"1'000", "0x1.8p-3f", "1e+5", "0xE", "+", "1", ".5f", "1.f"}));
}

TEST(Lexer, ReadsLettersOfNamesThatAreSpelledByTheirNumbers) {
    EXPECT_EQ(words("gr\\u00f6\\U000000dfe(\\u{3b1}x)"), (Words{"gr\u00f6\u00dfe", "(", "\u03b1x", ")"}));
    EXPECT_EQ(words("#define \\u00f6(x)"), (Words{"#", "define", "\u00f6", "(", "x", ")"}));
    EXPECT_EQ(
        words("a\\u0062 \\ud800 \\u{} \\u{110000} \\u12"),
        (Words{"a", "\\", "u0062", "\\", "ud800", "\\", "u", "{", "}", "\\", "u", "{", "110000", "}", "\\", "u12"}));
    EXPECT_EQ(words("\"\\u00f6\""), (Words{"\"\\u00f6\""}));
    EXPECT_EQ(lex("a \\\nb\\u00f6\nc").tokens[2].line, 3u);
}

TEST(Lexer, LetsAnApostropheStandInADirective) {
    EXPECT_EQ(words("#error don't \"worry\nx '}' '\\'' L'a'"),
              (Words{"#", "error", "don", "'", "t", "\"", "worry", "x", "'}'", "'\\''", "L'a'"}));
}

TEST(Lexer, ReadsIncludesAsOneToken) {
    EXPECT_EQ(words("#include <a/b.h>\na < b"), (Words{"#", "include", "<a/b.h>", "a", "<", "b"}));
}

TEST(Lexer, EndsWhatDoesNotCloseAtTheEndOfLineOrFile) {
    EXPECT_EQ(words("a \"b\nc"), (Words{"a", "\"b", "c"}));
    EXPECT_EQ(words("a /* b\nc"), (Words{"a"}));
    EXPECT_EQ(lex("a /* b\nc").line_count, 2u);
    EXPECT_EQ(lex("").line_count, 0u);
    EXPECT_EQ(lex("\n").line_count, 1u);
}

}  // namespace
}  // namespace porttool::lexer_test

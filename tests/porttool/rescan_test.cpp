// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// A file of which one unit was scanned again is what the whole makes of it; the oracle is scan_text().
#include "porttool/sync/rescan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>

#include "porttool/scan/scan.h"
#include "porttool/sync/rewrite.h"
#include "porttool/sync/unified_diff.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::rescan_test {
namespace {

std::string told(const ScannedFile& file) {
    std::string out;
    const auto number = [&](uint64_t value) {
        std::array<char, 20> digits;
        out.append(digits.data(), std::to_chars(digits.begin(), digits.end(), value).ptr).push_back(' ');
    };
    const auto add = [&](auto... values) { (number(static_cast<uint64_t>(values)), ...); };
    const auto range = [&](TokenRange one) { add(one.first, one.end); };
    for (const Token& one : file.lexed.tokens)
        add(one.offset, one.length, one.line, static_cast<int>(one.kind), static_cast<int>(one.flags));
    out += "\nunits ";
    for (const Unit& unit : file.units) {
        out += unit.name + " ";
        add(static_cast<int>(unit.kind), unit.start_line, unit.end_line, unit.name_token, unit.namespace_length);
        for (const TokenRange one : {unit.tokens, unit.parameters, unit.body}) range(one);
        for (const TokenRange one : unit.holes) range(one);
    }
    out += "\nrest ";
    for (const Directive& one : file.lexed.directives)
        add(static_cast<int>(one.kind), one.first_token, one.end_token, one.line, one.end_line);
    for (const LineSpan& one : file.lexed.comments) add(one.first, one.last);
    for (const Suppression& one : file.lexed.suppressions) add(one.line);
    for (const uint32_t one : file.lexed.line_starts) add(one);
    for (const LineClass one : file.lines) add(static_cast<int>(one));
    for (const FileVariable& one : file.variables) {
        add(one.name_token, static_cast<int>(one.about));
        range(one.tokens);
    }
    add(file.lexed.line_count, static_cast<int>(file.balanced), static_cast<int>(file.language));
    return out + file.lexed.text;
}

/// Edits of a unit: a line more, a number more of digits, a line less, a brace too many, a comment, a directive.
std::vector<TextEdit> edits_of(const ScannedFile& file, const Unit& unit) {
    const LexedText& lexed = file.lexed;
    std::vector<TextEdit> out;
    if (unit.body.empty()) {  // a constant, or a struct that is only declared
        constexpr std::array kTexts = {"123456", "7;\nint more = 7", "7\n    + 8", "7 /* said */", "7; 8"};
        for (uint32_t i = unit.tokens.first; i < unit.tokens.end && out.empty(); ++i)
            if (lexed.tokens[i].kind == TokenKind::Number)
                out.push_back({lexed.tokens[i].offset, lexed.tokens[i].offset + lexed.tokens[i].length,
                               kTexts[unit.start_line % kTexts.size()]});
        return out;
    }
    const Token &open = lexed.tokens[unit.body.first], &close = lexed.tokens[unit.body.end - 1];
    const size_t in = open.offset + (lexed.view(open) == "{" ? 1 : 0);
    for (const char* text :
         {"\n    int inserted = 7;\n    {\n    }", " {", " /* said */", "\n#define HERE 1\n", " \"", "'"})
        out.push_back({in, in, text});
    for (uint32_t i = unit.body.first; i < unit.body.end; ++i)
        if (lexed.tokens[i].kind == TokenKind::Number) {
            out.push_back({lexed.tokens[i].offset, lexed.tokens[i].offset + lexed.tokens[i].length, "123456.0f"});
            break;
        }
    if (close.offset > in) out.push_back({in, close.offset, ""});
    return out;
}

TEST(RescanUnit, GivesWhatTheWholeFileGives) {
    size_t alone = 0, all = 0;
    const auto hold = [&](const std::string& path) {
        const std::string text = testing::read_text(path);
        const ScannedFile file = scan_text(path, text);
        if (file.lexed.text != text) return;  // it has spliced lines, which its scanned text has no more
        const std::string before = told(file);
        for (const Unit& unit : file.units)
            for (const TextEdit& edit : edits_of(file, unit)) {
                ScannedFile edited = file;
                const auto place = static_cast<size_t>(&unit - file.units.data());
                const bool done = rescan_unit(edited, place, {edit}).has_value();
                const std::string now = with_edits(file.lexed.text, {edit});
                EXPECT_EQ(told(edited), done ? told(scan_text(path, now)) : before)
                    << path << " " << unit.name << edit.text;
                ++all;
                alone += done;
            }
    };
    for (const char* folder : {"tests/porttool/fixtures", "source_core/kernels", "target_core/kernels"})
        for (const auto& entry : std::filesystem::directory_iterator(std::string(REPOSITORY) + "/" + folder))
            if (language_of_path(entry.path().string()) != Language::Unknown) hold(entry.path().string());
    EXPECT_GT(alone, 300u) << "of " << all;
}

TEST(RescanUnit, UnitsThatShareALineOrAreReadOtherwiseAloneAreLeftToTheWhole) {
    for (const char* text : {"float f() { return 1.0; } float g() { return 2.0; }\n", "float f() { return 1.0; }",
                             "#if A\nfloat f() { return 1.0; }\n#else\nfloat g() { return 2.0; }\n#endif\n"}) {
        ScannedFile file = scan_text("a.cu", text);
        const std::string before = told(file);
        const size_t at = file.lexed.text.find("1.0");
        ASSERT_EQ(file.units.front().name, "f");
        EXPECT_FALSE(rescan_unit(file, 0, {{at, at + 3, "h(3.0)"}}).has_value()) << text;
        EXPECT_EQ(told(file), before);
    }
}

/// Numbers that change within a line leave all as it is read, whatever stands around; anything else than numbers, and
/// the conditions of the preprocessor, do not.
TEST(RescanUnit, NumbersInOneLineAreChangedWhereverTheyStand) {
    struct Row {
        const char *text, *number, *now;
        bool is_done;
    };
    const std::string around = "int first = 3;\n",
                      behind = "\nfloat last(float x) { return x; } // said\n#if 1\n#endif\n";
    for (const Row& row : std::vector<Row>{{"#define N (1.0 + 2)", "1.0", "12345.5f", true},
                                           {"#define N 1.0", "1.0", "2", true},
                                           {"#define F(x) ((x) * 1.0)", "1.0", "0x10", true},
                                           {"#if A\n#define N 1.0\n#else\n#define N 2\n#endif", "1.0", "3.0", true},
                                           {"const float k = 1.0;", "1.0", "30", true},
                                           {"float f() { return 1.0; } float g() { return 2.0; }", "1.0", "3.25", true},
                                           {"#define N (1.0 + 2)", "1.0", "-1.0", false},
                                           {"#define N 1.0", "1.0", "x", false},
                                           {"#define N 1.0", "1.0", "1 2", false},
                                           {"#define N 1.0", "1.0", "1 \\\n", false},
                                           {"#define N 1.0", "1.0", "1 // said", false},
                                           {"#define N 1.0 // said", "1.0", "2.0", false},
                                           {"#define N 1.0 + \\\n    2", "1.0", "2.0", false},
                                           {"#define N \"1.0\"", "1.0", "2.0", false},
                                           {"#define N \"1.0\"", "1.0", "\"", false}}) {
        const std::string text = around + row.text + behind;
        ScannedFile file = scan_text("a.cu", text);
        const size_t at = text.find(row.number);
        const auto unit = std::find_if(file.units.begin(), file.units.end(), [&](const Unit& one) {
            const LexedText& lexed = file.lexed;
            return lexed.tokens[one.tokens.first].offset <= at && at < lexed.tokens[one.tokens.end - 1].offset + 8u;
        });
        ASSERT_NE(unit, file.units.end()) << row.text;
        const TextEdit edit{at, at + 3, row.now};
        const std::string before = told(file);
        EXPECT_EQ(rescan_unit(file, static_cast<size_t>(unit - file.units.begin()), {edit}).has_value(), row.is_done)
            << row.text << " " << row.now;
        EXPECT_EQ(told(file), row.is_done ? told(scan_text("a.cu", with_edits(text, {edit}))) : before) << row.text;
    }
    // A condition decides what is read.
    const std::string text = "#if 1\nint a = 3;\n#endif\nint b = 4;\n";
    ScannedFile file = scan_text("a.cu", text);
    for (size_t unit = 0; unit < file.units.size(); ++unit)
        EXPECT_FALSE(rescan_unit(file, unit, {{4, 5, "0"}}).has_value());
}

TEST(UnifiedDiff, OfALongTextIsThatOfItsPart) {
    std::string lines, more;
    for (int i = 0; i < 40; ++i) lines += "line " + std::to_string(i) + "\n";
    EXPECT_EQ(unified_diff("a", lines, testing::replaced(lines, "line 20\n", "line 21\n")),
              "diff --git a/a b/a\n--- a/a\n+++ b/a\n@@ -18,7 +18,7 @@\n line 17\n line 18\n line 19\n-line 20\n+line "
              "21\n line 21\n line 22\n line 23\n");
    EXPECT_EQ(unified_diff("a", "a\na\na\n", "a\na\na\na\n"),
              "diff --git a/a b/a\n--- a/a\n+++ b/a\n@@ -1,3 +1,4 @@\n a\n a\n a\n+a\n");
    EXPECT_EQ(unified_diff("a", "\n\nb", "\n\nb\n"),
              "diff --git a/a b/a\n--- a/a\n+++ b/a\n@@ -1,3 +1,3 @@\n \n \n-b\n\\ No newline at end of file\n+b\n");
}

}  // namespace
}  // namespace porttool::rescan_test

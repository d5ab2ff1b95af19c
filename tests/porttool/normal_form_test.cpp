// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/normal_form.h"

#include "tests/porttool/fixtures.h"

namespace porttool::testing::normal_form_test {
namespace {

std::string print_of(const std::string& text) {
    const ScannedFile file = scan_text("a.cpp", text);
    return file.units.empty() ? "no unit" : fingerprint(normal_form(file, file.units.front()).words()).text();
}

TEST(NormalForm, CosmeticEditsKeepTheFingerprint) {
    const std::string before = print_of("float f(int a) {\n  if (a > 0) { return 0.5f; }\n  else return 16;\n}\n");
    EXPECT_EQ(print_of("float f( int a ){ if(a>0) return .5F; /* why */ else { return 0x10; } }"), before);
    EXPECT_EQ(
        print_of(
            "float f(int a) {\n#if 0\n  old();\n#endif\n  if (a > 0)\n    return 0.50f;\n  else\n    return 16;\n}\n"),
        before);
}

TEST(NormalForm, SemanticEditsChangeIt) {
    const std::string before = print_of("float f(int a) { if (a > 0) { return 0.5f; } return 1.0f; }");
    EXPECT_NE(print_of("float f(int a) { if (a >= 0) { return 0.5f; } return 1.0f; }"), before);
    EXPECT_NE(print_of("float f(int a) { if (a > 0) { return 0.25f; } return 1.0f; }"), before);
    EXPECT_NE(print_of("float f(int a) { if (a > 0) { return 0.5; } return 1.0f; }"), before);
    EXPECT_NE(print_of("float f(int a) { { return 0.5f; } return 1.0f; }"), before);
}

TEST(NormalForm, BracesThatChangeTheMeaningCount) {
    EXPECT_NE(print_of("void f() { if (a) { if (b) c(); } else d(); }"),
              print_of("void f() { if (a) if (b) c(); else d(); }"));
    EXPECT_EQ(print_of("void f() { if (a) { if (b) c(); else d(); } }"),
              print_of("void f() { if (a) if (b) c(); else d(); }"));
    EXPECT_EQ(print_of("void f() { for (;;) { do { g(); } while (x); } }"),
              print_of("void f() { for (;;) do g(); while (x); }"));
    EXPECT_EQ(print_of("void f() { if (a) g(); else if (b) h(); }"),
              print_of("void f() { if (a) { g(); } else { if (b) { h(); } } }"));
}

TEST(NormalForm, NumbersHaveOneSpelling) {
    EXPECT_EQ(normal_number("0.0F"), normal_number("0.f"));
    EXPECT_EQ(normal_number("1e-3f"), normal_number("0.001f"));
    EXPECT_EQ(normal_number("1'000u"), normal_number("1000U"));
    EXPECT_EQ(normal_number("0x1p1"), normal_number("2.0"));
    EXPECT_NE(normal_number("1.0"), normal_number("1"));
    EXPECT_NE(normal_number("1.0"), normal_number("1.0f"));
    EXPECT_NE(normal_number("010"), normal_number("10"));
}

TEST(NormalForm, TheOwnNameIsLeftOutSoThatARenamedUnitIsRecognised) {
    EXPECT_EQ(print_of("int f(int a) { return a; }"), print_of("int g(int a) { return a; }"));
}

TEST(NormalForm, AVeryDeepBodyIsRead) {
    std::string deep = "void f() {";
    for (int i = 0; i < 100000; ++i) deep += "if (a) ";
    EXPECT_NE(print_of(deep + "b(); }"), print_of(deep + "c(); }"));
}

}  // namespace
}  // namespace porttool::testing::normal_form_test

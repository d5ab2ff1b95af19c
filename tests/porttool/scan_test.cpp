// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Small texts, one hard case each.
#include "porttool/normal/unit_state.h"
#include "tests/porttool/fixtures.h"

namespace porttool::testing::scan_test {
namespace {

TEST(Scan, MainOfAShaderIsAKernelAndThatOfAProgramIsNot) {
    EXPECT_EQ(units_of("a.comp", "void main() {}\n"), "kernel 1-1 main\n");
    EXPECT_EQ(units_of("a.cpp", "int main() {}\n"), "function 1-1 main\n");
}

TEST(Scan, AListThatABraceClosedIsNoFunction) {
    for (const char* text :
         {"int(*{s(}){", "int (*{ f( }) { return 1; }\n", "void g(int * u node *)) {}\nint (*{ h( }) {\n"})
        EXPECT_TRUE(scan_text("a.cpp", text).units.size() <= 2) << text;
    EXPECT_EQ(scan_text("a.cpp", "int (*{ f( }) {}\nint after() { return 1; }\n").units.back().name, "after");
}

TEST(Scan, ABlockWithLayoutIsNoFunction) {
    EXPECT_EQ(
        units_of("a.rgen", "layout(set = 0, binding = 1) uniform Camera {\n  mat4 view;\n} camera;\nvoid main() {}\n"),
        "struct 1-3 Camera\nkernel 4-4 main\n");
}

TEST(Scan, LayoutBeforeMainDoesNotHideIt) {
    EXPECT_EQ(units_of("a.comp", "layout(local_size_x = 8, local_size_y = 8) in;\nvoid main()\n{\n}\n"),
              "kernel 2-4 main\n");
}

TEST(Scan, BranchesThatAreWholeFunctionsAreVariants) {
    EXPECT_EQ(units_of("a.cu", "#ifdef A\nint f(int a) { return a; }\n#else\nint f(int a) { return -a; }\n#endif\n"),
              "function 2-2 f\nfunction 4-4 f#2\n");
}

TEST(Scan, OfTwoHeadsForOneBodyTheFirstCounts) {
    EXPECT_EQ(
        units_of("a.cu",
                 "#ifdef A\nint f(int a) {\n#else\nint g(float a) {\n#endif\n  return 1;\n}\nint h() { return 2; }\n"),
        "function 2-7 f\nfunction 8-8 h\n");
}

TEST(Scan, ABranchFourTimesLongerCountsInsteadOfTheFirst) {
    EXPECT_EQ(units_of("a.cu",
                       "#ifdef A\nint f() {\n#else\nint helper(int a) { return a + a + a + a + a + a; }\n"
                       "int g(float a) {\n#endif\n  return 1;\n}\n"),
              "function 4-4 helper\nfunction 5-8 g\n");
}

TEST(Scan, DeadCodeIsNoUnit) {
    EXPECT_EQ(
        units_of("a.cl",
                 "#if 0\nint f() { }\n#else\nint g() { }\n#endif\n#if 1\nint h() { }\n#else\nint i() { }\n#endif\n"),
        "function 4-4 g\nfunction 7-7 h\n");
}

TEST(Scan, FunctionsWithinFunctionsStayInside) {
    EXPECT_EQ(units_of("a.cpp",
                       "int f() {\n  struct L { int g() { return 1; } };\n  auto h = [](int x) { return x; };\n  "
                       "return h(L().g());\n}\n"),
              "function 1-5 f\n");
}

TEST(Scan, AFileOnlyScopeIsNotInTheName) {
    EXPECT_EQ(units_of("a.cpp", "namespace { namespace b { int f() { return 1; } } }\n"), "function 1-1 b::f\n");
}

TEST(Scan, ANameOfAMacroIsReadFromItsDefinition) {
    EXPECT_EQ(units_of("a.h", "#define FN(n) bvh_##n##_motion\nint FN(trace)(int a) { return a; }\n"),
              "constant 1-1 FN\nfunction 2-2 bvh_trace_motion\n");
    EXPECT_EQ(units_of("a.h", "int FN(trace)(int a) { return a; }\n"), "function 1-1 trace\n");
}

TEST(Scan, AMacroOnItsOwnLineBelongsToTheFunctionOnlyWithoutAGap) {
    EXPECT_EQ(units_of("a.cpp", "ATTR(1)\nint f() {}\n"), "function 1-2 f\n");
    EXPECT_EQ(units_of("a.cpp", "EXPORT(Foo)\n\nint f() {}\n"), "function 3-3 f\n");
    EXPECT_EQ(units_of("a.cpp", "EXPORT(Foo)\n\nFoo::Foo(int a) : b(a), c{a} {\n}\n"), "function 3-4 Foo::Foo\n");
}

TEST(Scan, InitialisersAreNotBodies) {
    EXPECT_EQ(units_of("a.cpp", "Foo x{1, 2};\nstd::vector<int> y = {1, 2};\nint f() { return 1; }\n"),
              "function 3-3 f\n");
}

TEST(Scan, KernelsThatTheHostHasAsAStringAreUnits) {
    EXPECT_EQ(
        units_of("kernels.h",
                 "#define TEXT(...) #__VA_ARGS__\n"
                 "static const char *program =\n"
                 "  \"#define HALF 0.5f\"\n"
                 "  TEXT(\n"
                 "    inline float half_of(float x) { return x * HALF; }\n"
                 "    __kernel void halve(__global float *x) {\n"
                 "      x[get_global_id(0)] = half_of(x[get_global_id(0)]);\n"
                 "    }\n"
                 "  )\n"
                 "  TEXT(float twice(float x) { return x + x; });\n"
                 "int after(void) { return 1; }\n"),
        "constant 1-1 TEXT\nfunction 5-5 half_of\nkernel 6-8 halve\nfunction 10-10 twice\nfunction 11-11 after\n");
    const char* none[] = {"auto f = call([](int a) { return a; });\n", "auto f = call(Foo(1) , { 1 });\n",
                          "int x = sum({1, 2}, max(a, b));\n",
                          "std::function<int(int)> f = bind(x, [&](int b) -> int { return b; });\n"};
    for (const char* text : none) EXPECT_EQ(units_of("a.cpp", text).find("function"), std::string::npos) << text;
}

TEST(Scan, EnumsCarryValues) {
    EXPECT_EQ(units_of("a.cpp", "class A {\n  int a;\n  int f() { return a; }\n  int b;\n};\n"),
              "struct 1-5 A\nfunction 3-3 A::f\n")
        << "a class ends at its closing brace, around what it defines inside";
    EXPECT_EQ(units_of("a.cpp", "enum class Mode : int {\n  A = 1,\n};\n"), "constant 1-3 Mode\n");
}

TEST(Scan, IncludeGuardsAndQualifierWordsCarryNone) {
    EXPECT_EQ(units_of("a.h", "#ifndef A_H\n#define A_H\n#define INLINE static inline\n#define PI 3.14f\n#endif\n"),
              "constant 4-4 PI\n");
}

TEST(Scan, ClassesWithinMoreThan64OthersAreTextOfTheOneAround) {
    std::string text, closing;
    for (int k = 0; k < 100; ++k) {
        text += "struct S" + std::to_string(k) + " {\n";
        closing += "};\n";
    }
    const auto scanned = [&](const std::string& deepest) {
        return scan_text("a.cpp", text + deepest + closing + "int after() { return 1; }\n");
    };
    const ScannedFile file = scanned("int x;\n"), edited = scanned("int y;\n");
    ASSERT_EQ(file.units.size(), 65u);
    EXPECT_EQ(file.units[63].end_line, 201u - 63u);
    EXPECT_EQ(file.units[64].name, "after");
    for (size_t k = 0; k < 65; ++k)
        EXPECT_EQ(unit_state(file, file.units[k]).text == unit_state(edited, edited.units[k]).text, k != 63) << k;
}

TEST(Scan, EmptyAndOddFilesHaveNoUnits) {
    EXPECT_EQ(units_of("a.cpp", ""), "");
    EXPECT_EQ(units_of("a.cpp", "}}}\n"), "");
    EXPECT_EQ(units_of("a.cpp", "#else\n#endif\n#endif\nint f() {}\n"), "function 4-4 f\n");
}

// One brace too many: what is indented tells where the others belong, within a macro's parentheses, too.
TEST(Scan, ALostBraceCostsNoKernelWithinAMacro) {
    const auto kernels = [](const std::string& indent, const std::string& head_end) {
        std::string out;
        for (const char* name : {"one", "two", "three"})
            out += indent + "STRINGIFY(\n" + indent + "  __kernel void " + name + "(__global float* a,\n" + indent +
                   "                 const int n)" + head_end + indent + "    if (n > 0) {\n" + indent +
                   "      a[n] = 1.0f;\n" + indent + "    }\n" + indent + "  }\n" + indent + ")\n\n";
        return out;
    };
    for (const std::string indent : {"", "    "})
        for (const std::string& head_end : {std::string(" {\n"), "\n" + indent + "  {\n"})
            for (const std::string lost : {"}\n", ""}) {
                const ScannedFile file = scan_text("a.h", kernels(indent, head_end) + lost + "void four() {\n}\n");
                std::vector<std::string> names;
                for (const Unit& unit : file.units) names.push_back(unit.name);
                EXPECT_EQ(names, (std::vector<std::string>{"one", "two", "three", "four"}))
                    << lost << indent << head_end;
            }
}

TEST(Scan, AFunctionCutOffByTheEndIsStillThere) {
    EXPECT_EQ(units_of("a.cpp", "int f() {\n  if (a) {\n"), "function 1-2 f\n");
}

}  // namespace
}  // namespace porttool::testing::scan_test

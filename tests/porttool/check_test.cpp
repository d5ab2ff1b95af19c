// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The gate: what is in step, what is not, and what a person can say about it.
#include <gtest/gtest.h>

#include "tests/porttool/run_command.h"

namespace porttool::testing::check_test {
namespace {

const char* kSource = R"(
#define MAX_PATH_LENGTH 8
struct Hit { float t; float u, v; int prim; };
__device__ float luminance(const float3 c) { return dot(c, make_float3(0.299f, 0.587f, 0.114f)); }
__device__ float3 shade(const Hit hit, const float3 throughput, float pdf) {
    float3 result = make_float3(0.0f);
    if (hit.t < 0.0f) { return result; }
    float weight = luminance(throughput) / max(pdf, 1e-6f);
    result = lerp(result, throughput, weight);
    return result * 0.5f;
}
)";
const char* kTarget = R"(#version 450
#define MAX_PATH_LENGTH 8
struct Hit { float t; float u, v; int prim; };
float luminance(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }
vec3 shade(Hit hit, vec3 throughput, float pdf) {
    vec3 result = vec3(0.0);
    if (hit.t < 0.0) { return result; }
    float weight = luminance(throughput) / max(pdf, 1e-6);
    result = mix(result, throughput, weight);
    return result * 0.5;
}
)";

TEST(Check, AFreshMapIsInStep) {
    MemoryDisk disk = started(kSource, kTarget);
    const auto report = check(disk);
    EXPECT_EQ(report["verdict"], "in_step");
    EXPECT_EQ(report["summary"]["pairs"], 4);
    EXPECT_EQ(report["summary"]["in_step"], 4);
    EXPECT_TRUE(report["findings"].empty());
}

TEST(Check, InitRefusesToReplaceAndCheckNeedsALock) {
    MemoryDisk disk = started(kSource, kTarget);
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"}).exit_code, 2);
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*", "--force"}).exit_code, 0);
    disk.files.erase("/r/portmap.lock");
    const CommandRun got = run(disk, {"-C", "/r", "check"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("porttool init"), std::string::npos);
}

TEST(Check, ASourceEditWithoutPortIsDrift) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] =
        replaced(kSource, "float weight =", "if (pdf <= 0.0f) return result;\n    float weight =");
    const CommandRun got = run(disk, {"-C", "/r", "check", "--format", "json"});
    EXPECT_EQ(got.exit_code, 1);
    const auto report = nlohmann::json::parse(got.out);
    ASSERT_EQ(rules(report), Rules{"source-changed"});
    const auto& finding = report["findings"][0];
    EXPECT_EQ(finding["level"], "error");
    EXPECT_EQ(finding["change"], "semantic");
    EXPECT_EQ(finding["source"]["id"], "src/k.cu:shade");
    EXPECT_EQ(finding["target"]["id"], "port/k.comp:shade");
    EXPECT_NE(finding["message"].get<std::string>().find("if (pdf <= 0f)"), std::string::npos) << finding["message"];
    EXPECT_EQ(report["verdict"], "drift");
    EXPECT_EQ(report["summary"]["drifted"], 1);
}

TEST(Check, CosmeticEditsRaiseNothing) {
    MemoryDisk disk = started(kSource, kTarget);
    std::string text = replaced(kSource, "if (hit.t < 0.0f) { return result; }",
                                "// gone\n    if (hit.t < 0.F)\n        return result;");
    text = replaced(
        text, "float weight = luminance(throughput) / max(pdf, 1e-6f);\n    result = lerp(result, throughput, weight);",
        "float w = luminance(throughput) / max(pdf, 0.000001f);\n    result = lerp(result, throughput, w);");
    disk.files["/r/src/k.cu"] = text;
    EXPECT_EQ(check(disk)["verdict"], "in_step");
}

TEST(Check, ANameThatAMacroSpellsIsNoMatterOfTaste) {
    const std::string quotes = "#define SHOW(v) show(#v, v)\n", pastes = "#define ROW(v) row_##v(0)\n",
                      hands_on = "#define TELL(v) SHOW(v)\n" + quotes, values = "#define TWICE(v) ((v) + (v))\n";
    const auto renamed = [](const std::string& macros, const std::string& call) {
        const std::string kernel =
            "__device__ float f(float a) {\n    float b = a;\n    " + call + ";\n    return b;\n}\n";
        MemoryDisk disk =
            started(macros + kernel, macros + "float f(float a) { float b = a; " + call + "; return b; }\n");
        EXPECT_EQ(check(disk)["verdict"], "in_step");
        const std::string other =
            "    float other = a;\n    " + replaced(call, "(b", "(other") + ";\n    return other;\n}\n";
        disk.files["/r/src/k.cu"] = macros + "__device__ float f(float a) {\n" + other;
        return rules(check(disk));
    };
    EXPECT_EQ(renamed(quotes, "SHOW(b)"), Rules{"source-changed"}) << "another text is shown";
    EXPECT_EQ(renamed(hands_on, "TELL(b * 2.0f)"), Rules{"source-changed"});
    EXPECT_EQ(renamed(pastes, "ROW(b)"), Rules{"source-changed"}) << "another function is called";
    EXPECT_EQ(renamed(values, "TWICE(b)"), Rules{});
    EXPECT_EQ(renamed(quotes, "TWICE(b)"), Rules{}) << "the macro is not used";
}

TEST(Check, ARenamingThatIsNotOneIsSemantic) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] = replaced(kSource, "max(pdf, 1e-6f)", "max(throughput, 1e-6f)");
    EXPECT_EQ(rules(check(disk)), Rules{"source-changed"});
    disk.files["/r/src/k.cu"] = replaced(kSource, "hit.t < 0.0f", "hit.u < 0.0f");  // a member is no local
    EXPECT_EQ(rules(check(disk)), Rules{"source-changed"});
    disk.files["/r/src/k.cu"] = replaced(kSource, "luminance(throughput)", "average(throughput)");
    EXPECT_EQ(rules(check(disk)), Rules{"source-changed"});
}

TEST(Check, AChangedNumberIsAConstantChange) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] = replaced(kSource, "result * 0.5f", "result * 0.25f");
    EXPECT_EQ(check(disk)["findings"][0]["change"], "constant");
}

TEST(Check, TheSameEditOnBothSidesIsInStep) {
    const std::vector<std::pair<std::pair<std::string, std::string>, std::pair<std::string, std::string>>> edits = {
        {{"float weight =", "if (pdf <= 0.0f) return result;\n float weight ="},
         {"float weight =", "if (pdf <= 0.0) { return result; }\n float weight ="}},
        {{"result * 0.5f", "result * 0.25f"}, {"result * 0.5", "result * .25"}},
        {{"lerp(result, throughput, weight)", "lerp(throughput, result, weight)"},
         {"mix(result, throughput, weight)", "mix(throughput, result, weight)"}},
        {{"max(pdf, 1e-6f)", "fmaxf(pdf, 1e-5f)"}, {"max(pdf, 1e-6)", "max(pdf, 1e-5)"}},
        {{"hit.t < 0.0f", "hit.t <= 0.0f"}, {"hit.t < 0.0", "hit.t <= 0.0"}},
        {{"return result * 0.5f;", "result += make_float3(1.0f);\n return result * 0.5f;"},
         {"return result * 0.5;", "result += vec3(1.0);\n return result * 0.5;"}},
        {{"if (hit.t < 0.0f) { return result; }", ""}, {"if (hit.t < 0.0) { return result; }", ""}},
        {{"float3 result = make_float3(0.0f);", "float3 result = make_float3(rsqrtf(pdf));"},
         {"vec3 result = vec3(0.0);", "vec3 result = vec3(inversesqrt(pdf));"}},
        {{"#define MAX_PATH_LENGTH 8", "#define MAX_PATH_LENGTH 12"},
         {"#define MAX_PATH_LENGTH 8", "#define MAX_PATH_LENGTH 0xC"}},
        {{"int prim;", "int prim; int inst;"}, {"int prim;", "int prim; int inst;"}}};
    for (const auto& [source, target] : edits) {
        MemoryDisk disk = started(kSource, kTarget);
        disk.files["/r/src/k.cu"] = replaced(kSource, source.first, source.second);
        disk.files["/r/port/k.comp"] = replaced(kTarget, target.first, target.second);
        const auto report = check(disk);
        EXPECT_EQ(report["verdict"], "in_step") << source.second << "\n" << report.dump(1);
    }
}

TEST(Check, AWrongPortIsNamed) {
    struct Wrong {
        std::string source_from, source_to, target_from, target_to, rule, says;
    };
    const std::vector<Wrong> cases = {
        {"float weight =", "if (pdf <= 0.0f) return result;\n float weight =", "float weight =",
         "float unused = 1.0;\n float weight =", "port-differs", "if (pdf <= 0f)"},
        {"result * 0.5f", "result * 0.25f", "result * 0.5", "result * 0.75", "port-differs", "0.25"},
        {"lerp(result, throughput, weight)", "lerp(throughput, result, weight)", "mix(result, throughput, weight)",
         "mix(result, throughput, 1.0 - weight)", "port-differs", "throughput, result"},
        {"hit.t < 0.0f", "hit.t <= 0.0f", "hit.t < 0.0", "hit.t > 0.0", "port-differs", "<="},
        {"max(pdf, 1e-6f)", "max(pdf, 1e-5f)", "max(pdf, 1e-6)", "max(pdf, 1e-4)", "port-differs", "1e-05"},
        {"if (hit.t < 0.0f) { return result; }", "", "result = mix(result, throughput, weight);", "", "port-differs",
         "lost"},
        {"luminance(throughput)", "luminance(result)", "luminance(throughput)", "luminance(vec3(pdf))", "port-differs",
         "luminance"},
        {"float weight =", "if (pdf <= 0.0f) return result;\n float weight =", "return result * 0.5;",
         "if (pdf <= 0.0) return result;\n return result * 0.5;", "port-differs", "different places"},
        {"#define MAX_PATH_LENGTH 8", "#define MAX_PATH_LENGTH 12", "#define MAX_PATH_LENGTH 8",
         "#define MAX_PATH_LENGTH 7", "constant-differs", "'12'"},
        {"int prim;", "int prim; int inst;", "int prim;", "int inst; int prim;", "layout-differs", "inst"}};
    for (const Wrong& wrong : cases) {
        MemoryDisk disk = started(kSource, kTarget);
        disk.files["/r/src/k.cu"] = replaced(kSource, wrong.source_from, wrong.source_to);
        disk.files["/r/port/k.comp"] = replaced(kTarget, wrong.target_from, wrong.target_to);
        const auto report = check(disk);
        ASSERT_EQ(rules(report), Rules{wrong.rule}) << wrong.target_to << report.dump(1);
        EXPECT_NE(report.dump().find(wrong.says), std::string::npos) << report.dump(1);
    }
}

/// Fields whose declaration has brackets are fields.
TEST(Check, FieldsWithBracketsAreData) {
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"ALIGNED(16) float3 v", "ALIGNED(16) float4 v"},
             {"void (*v)(int)", "void (*v)(float)"},
             {"std::function<void(int)> v", "std::function<void(float)> v"}}) {
        const std::string text = "struct Ray { float t; " + from + "; float at(int i) const; };\n";
        MemoryDisk disk;
        disk.files = {{"/r/src/k.cu", text}, {"/r/port/k.cpp", text}};
        run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
        disk.files["/r/src/k.cu"] = replaced(text, from, to);
        EXPECT_FALSE(check(disk)["findings"].empty()) << to;
        disk.files["/r/src/k.cu"] = replaced(text, " float at(int i) const;", "");
        EXPECT_TRUE(check(disk)["findings"].empty()) << from << ": a member function is no data";
    }
}

/// The same words put in at another place are another program.
TEST(Check, TheSameEditAtAnotherPlaceIsAWrongPort) {
    const std::string source =
        "__device__ float f(float x, float y, float pdf) {\n    float a = x * 0.5f;\n    float b = y * 0.5f;\n"
        "    if (pdf < 1e-4f) { return 0.0f; }\n    float w = fmaxf(a, b) / pdf;\n    store(w, a, b);\n"
        "    return w * a - b;\n}\n";
    const std::string target =
        "float f(float x, float y, float pdf) {\n    float a = x * 0.5;\n    float b = y * 0.5;\n"
        "    if (pdf < 1e-4) { return 0.0; }\n    float w = max(a, b) / pdf;\n    store(w, a, b);\n"
        "    return w * a - b;\n}\n";
    const std::vector<std::pair<std::pair<std::string, std::string>, std::pair<std::string, std::string>>> edits = {
        {{"x * 0.5f", "x * 0.25f"}, {"y * 0.5", "y * 0.25"}},
        {{"fmaxf(a, b)", "fmaxf(a, a)"}, {"store(w, a, b)", "store(w, a, a)"}},
        {{"{ return 0.0f; }", "{ note(); } return 0.0f;"}, {"{ return 0.0; }", "{ note(); return 0.0; }"}},
        {{"store(w, a, b);", "store(w, a, b); store(w, a, b);"}, {"store(w, a, b);", "store(w, a, b); note();"}}};
    for (const auto& [left, right] : edits) {
        MemoryDisk disk = started(source, target);
        disk.files["/r/src/k.cu"] = replaced(source, left.first, left.second);
        disk.files["/r/port/k.comp"] = replaced(target, right.first, right.second);
        EXPECT_EQ(rules(check(disk)), Rules{"port-differs"}) << right.second;
    }
}

TEST(Check, ANameDeclaredAgainInABlockIsAnotherVariable) {
    const std::string source =
        "__device__ float f(float a) {\n    float x = a * 3.0f;\n    for (int i = 0; i < 4; ++i) { float x = a + i; a "
        "+= x; }\n"
        "    for (int i = 0; i < 2; ++i) { a += x; }\n    return a + x;\n}\n";
    MemoryDisk disk = started(source, replaced(source, "__device__ ", ""));
    disk.files["/r/src/k.cu"] =
        replaced(replaced(source, "float x = a + i", "float y = a + i"), "a += x; }", "a += y; }");
    EXPECT_EQ(check(disk)["verdict"], "in_step") << "consistent within its block";
    disk.files["/r/src/k.cu"] = replaced(source, "(int i = 0; i < 2; ++i)", "(int k = 0; k < 2; ++k)");
    EXPECT_EQ(check(disk)["verdict"], "in_step") << "a loop's variable ends with the loop";
    disk.files["/r/src/k.cu"] = replaced(source, "float x = a + i", "float y = a + i");
    EXPECT_EQ(check(disk)["verdict"], "drift") << "now the outer one is added";
    disk.files["/r/src/k.cu"] = replaced(source, "float x = a + i; ", "x = a + i; ");
    EXPECT_EQ(check(disk)["verdict"], "drift");
}

/// A renaming beside the edit hides neither that the edit is the same nor that it is another.
TEST(Check, LocalsMayBeRenamedBesideTheEditThatBothSidesMade) {
    const std::string source =
        "float total;\n__device__ float f(float x, float y, float pdf) {\n    float a = x * 0.5f;\n    float b = y + "
        "0.5f;\n"
        "    if (pdf < 1e-4f) { return 0.0f; }\n    float w = fmaxf(a, b) / pdf;\n    store(w, a, b);\n"
        "    return w * a - b;\n}\n";
    const std::string renamed =  // a is first, w is weight
        "float total;\nfloat f(float x, float y, float pdf) {\n    float first = x * 0.5;\n    float b = y + 0.5;\n"
        "    if (pdf < 1e-4) { return 0.0; }\n    float weight = max(first, b) / pdf;\n    store(weight, first, b);\n"
        "    return weight * first - b;\n}\n";
    const std::string target = replaced(replaced(source, "__device__ ", ""), "fmaxf", "max");
    using Edit = std::pair<std::string, std::string>;
    struct Row {
        Edit source, port;
        bool same;
    };
    const std::vector<Row> rows = {
        {{"x * 0.5f", "x * 0.25f"}, {"x * 0.5", "x * 0.25"}, true},
        {{"x * 0.5f", "x * 0.25f"}, {"x * 0.5", "x * 0.75"}, false},
        {{"return w * a - b", "return w * b - a"}, {"return weight * first - b", "return weight * b - first"}, true},
        {{"return w * a - b", "return w * b - a"}, {"return weight * first - b", "return first * b - weight"}, false},
        {{"store(w, a, b)", "store(w, b, a)"}, {"store(weight, first, b)", "store(weight, b, b)"}, false},
        {{"return w * a - b", "return w * a"}, {"return weight * first - b", "return weight * total"}, false},
        {{"store(w, a, b);", "float c = a + b; store(w, a, c);"},
         {"store(weight, first, b);", "float sum = first + b; store(weight, first, sum);"},
         true},
        {{"store(w, a, b);", "float c = a + b; store(w, a, c);"},
         {"store(weight, first, b);", "float sum = first + b; store(weight, sum, first);"},
         false},
        {{"store(w, a, b);", "float c = a + b; float d = a - b; store(w, c, d);"},
         {"store(weight, first, b);", "float s = first + b; float t = first - b; store(weight, s, t);"},
         true},
        {{"store(w, a, b);", "float c = a + b; float d = a - b; store(w, c, d);"},
         {"store(weight, first, b);", "float s = first + b; float t = first - b; store(weight, t, s);"},
         false},
        // not a renaming: one use still means the parameter, or the global
        {{"x * 0.5f", "x * 0.25f"}, {"x * 0.5;\n    float b = y", "x * 0.25;\n    float b = first"}, false},
        {{"x * 0.5f", "x * 0.25f"}, {"float first = x * 0.5;", "float first = x * 0.25; total = first;"}, false}};
    for (const Row& row : rows) {
        MemoryDisk disk = started(source, target);
        disk.files["/r/src/k.cu"] = replaced(source, row.source.first, row.source.second);
        disk.files["/r/port/k.comp"] = replaced(renamed, row.port.first, row.port.second);
        const auto report = check(disk);
        EXPECT_EQ(rules(report), row.same ? Rules{} : Rules{"port-differs"}) << row.port.second << report.dump(1);
    }
}

/// A local that takes over the name of a global, or another local's, is no renaming.
TEST(Check, ANameThatMeantSomethingElseIsNoRenaming) {
    const std::string source =
        "float scale;\n__device__ float f(float x, float gain) {\n    float a = x * 0.5f;\n    float b = x * scale;\n"
        "    return a * gain + b;\n}\n";
    const std::string target = replaced(source, "__device__ ", "");
    const std::vector<std::string> ports = {
        // the parameter is called as the global, which the body means no longer
        "float scale;\nfloat f(float x, float scale) {\n    float a = x * 0.25f;\n    float b = x * scale;\n"
        "    return a * scale + b;\n}\n",
        // a and b change places
        "float scale;\nfloat f(float x, float gain) {\n    float b = x * 0.25f;\n    float a = x * scale;\n"
        "    return a * gain + b;\n}\n",
        // a is split in two
        "float scale;\nfloat f(float x, float gain) {\n    float a = x * 0.25f;\n    float c = x * scale;\n"
        "    float b = c;\n    return b * gain + c;\n}\n"};
    for (const std::string& port : ports) {
        MemoryDisk disk = started(source, target);
        disk.files["/r/src/k.cu"] = replaced(source, "x * 0.5f", "x * 0.25f");
        disk.files["/r/port/k.comp"] = port;
        EXPECT_EQ(rules(check(disk)), Rules{"port-differs"}) << port;
    }
}

TEST(Check, NewGoneAndMovedUnits) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] = std::string(kSource) + "__device__ int fresh(int a) { return a + 1; }\n";
    EXPECT_EQ(rules(check(disk)), Rules{"unported"});
    disk.files["/r/src/k.cu"] = replaced(
        kSource, "__device__ float luminance(const float3 c) { return dot(c, make_float3(0.299f, 0.587f, 0.114f)); }",
        "");
    EXPECT_EQ(rules(check(disk)), Rules{"orphaned"});
    disk.files["/r/src/k.cu"] = kSource;
    disk.files["/r/port/k.comp"] =
        replaced(kTarget, "float luminance(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }", "");
    EXPECT_EQ(rules(check(disk)), Rules{"dead-link"});
    disk.files["/r/port/k.comp"] = replaced(kTarget, "float luminance(vec3 c)", "float brightness(vec3 c)");
    const auto report = check(disk);
    EXPECT_EQ(report["verdict"], "in_step") << report.dump(1);
    EXPECT_EQ(report["findings"][0]["change"], "rename");
}

TEST(Check, OrderOfFunctionsAndOfVariantsRaisesNothing) {
    const std::string one = "__device__ int pick(int a) { int b = a * 3; return b + 17; }\n";
    const std::string two = "__device__ int pick(float a) { float b = a * 5.0f; return int(b) - 4; }\n";
    MemoryDisk disk = started(one + two,
                              "int pick(int a) { int b = a * 3; return b + 17; }\nint pick(float a) { float b = a * "
                              "5.0; return int(b) - 4; }\n");
    EXPECT_EQ(check(disk)["summary"]["pairs"], 2);
    disk.files["/r/src/k.cu"] = two + one;
    EXPECT_EQ(check(disk)["verdict"], "in_step");
}

TEST(Check, AcceptDeferAndIgnore) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] = replaced(kSource, "result * 0.5f", "result * 0.25f");
    const std::string print = check(disk)["findings"][0]["fingerprint"];
    EXPECT_EQ(run(disk, {"-C", "/r", "defer", "src/k.cu:shade", "--owner", "me", "--until", "2999-01-01", "--reason",
                         "later"})
                  .exit_code,
              0);
    EXPECT_EQ(check(disk)["summary"]["deferred"], 1);
    EXPECT_EQ(check(disk)["verdict"], "in_step");
    EXPECT_NE(run(disk, {"-C", "/r", "explain", "src/k.cu:shade"})
                  .out.find("\ndeferred until 2999-01-01, to be ported by me\n"),
              std::string::npos);
    setenv("SOURCE_DATE_EPOCH", "946684800", 1);  // 2000-01-01
    EXPECT_EQ(run(disk, {"-C", "/r", "defer", print, "--owner", "me", "--until", "2001-01-01", "--reason", "later"})
                  .exit_code,
              0);
    unsetenv("SOURCE_DATE_EPOCH");
    EXPECT_EQ(rules(check(disk)), (Rules{"deferral-expired", "source-changed"}));
    EXPECT_EQ(run(disk, {"-C", "/r", "ignore", "port/k.comp:shade", "--reason", "GPU only"}).exit_code, 0);
    EXPECT_EQ(check(disk)["summary"]["ignored"], 1);
    disk.files["/r/src/k.cu"] = replaced(kSource, "result * 0.5f", "result * 0.125f");
    EXPECT_EQ(check(disk)["verdict"], "drift") << "an ignored text that changed again is a finding again";
    EXPECT_EQ(run(disk, {"-C", "/r", "accept", "src/k.cu:shade=port/k.comp:shade", "--reason", "checked"}).exit_code,
              0);
    EXPECT_EQ(check(disk)["verdict"], "in_step");
    const CommandRun unknown = run(disk, {"-C", "/r", "accept", "src/k.cu:shad"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_NE(unknown.err.find("did you mean 'src/k.cu:shade'"), std::string::npos) << unknown.err;
    EXPECT_EQ(run(disk, {"-C", "/r", "defer", "src/k.cu:shade", "--owner", "me", "--until", "soon", "--reason", "x"})
                  .exit_code,
              2);
}

TEST(Check, AcceptAllTakesOnlyEquivalentEdits) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] = replaced(replaced(kSource, "result * 0.5f", "result * 0.25f"), "0.299f", "0.3f");
    disk.files["/r/port/k.comp"] = replaced(kTarget, "0.299", "0.3");
    run(disk, {"-C", "/r", "accept", "--all"});
    EXPECT_EQ(rules(check(disk)), Rules{"source-changed"});
    run(disk, {"-C", "/r", "accept", "--all", "--force"});
    EXPECT_TRUE(check(disk)["findings"].empty());
}

TEST(Check, ExplainShowsBothEditsAndRules) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] = replaced(kSource, "result * 0.5f", "result * 0.25f");
    const CommandRun got = run(disk, {"-C", "/r", "explain", "src/k.cu:shade"});
    EXPECT_NE(got.out.find("- return result * 0.5f"), std::string::npos) << got.out;
    EXPECT_NE(got.out.find("+ return result * 0.25f"), std::string::npos) << got.out;
    EXPECT_NE(run(disk, {"explain", "port-differs"}).out.find("not the same after translation"), std::string::npos);
}

TEST(Check, APortThatIsDeletedIsToldAsOneThatIsEmptied) {
    std::vector<nlohmann::json> told;
    for (const bool deleted : {false, true}) {
        MemoryDisk disk = started(kSource, kTarget);
        disk.files["/r/port/k.comp"].clear();
        if (deleted) disk.files.erase("/r/port/k.comp");
        const CommandRun got = run(disk, {"-C", "/r", "check", "--format", "json"});
        EXPECT_EQ(got.exit_code, 1) << got.err;
        told.push_back(nlohmann::json::parse(got.out)["findings"]);
        EXPECT_FALSE(told.back().empty());
        for (const auto& finding : told.back()) EXPECT_EQ(finding["rule"], "dead-link");
    }
    EXPECT_EQ(told[0], told[1]);
    MemoryDisk disk = started(kSource, kTarget);
    disk.files.erase("/r/src/k.cu");  // it may not have been checked out: without it nothing can be said
    EXPECT_EQ(run(disk, {"-C", "/r", "check"}).exit_code, 2);
    disk = started(kSource, kTarget);
    disk.files["/r/portmap.toml"] = replaced(disk.files["/r/portmap.toml"], "port/*", "nowhere/*");
    EXPECT_EQ(run(disk, {"-C", "/r", "check"}).exit_code, 2) << "the map names nothing there";
}

TEST(Check, BadMapsAndLocksAreNamed) {
    MemoryDisk disk = started(kSource, kTarget);
    const std::string map = disk.files["/r/portmap.toml"], lock = disk.files["/r/portmap.lock"];
    auto error = [&](const std::string& map_text, const std::string& lock_text) {
        disk.files["/r/portmap.toml"] = map_text;
        disk.files["/r/portmap.lock"] = lock_text;
        const CommandRun got = run(disk, {"-C", "/r", "check"});
        EXPECT_EQ(got.exit_code, 2);
        EXPECT_EQ(got.out, "");
        return got.err;
    };
    EXPECT_NE(error("version = 1\n[sides\n", lock).find("portmap.toml:2:"), std::string::npos);
    EXPECT_NE(error("version = 1\n[sides]\nsorce = [\"a\"]\n", lock).find("did you mean 'source'"), std::string::npos);
    EXPECT_NE(error("version = 2\n", lock).find("version"), std::string::npos);
    EXPECT_NE(error(replaced(map, "src/*", "nowhere/*"), lock).find("'nowhere/*' matches no file"), std::string::npos);
    EXPECT_NE(error(map, replaced(lock, "porttool-lock\t2", "porttool-lock\t9")).find("another version"),
              std::string::npos);
    EXPECT_NE(error(map, lock + "<<<<<<< HEAD\n").find("merge conflict"), std::string::npos);
    EXPECT_NE(error(map, lock + "pair\tx\n").find("cannot be read"), std::string::npos);
    EXPECT_NE(error(map, "").find("empty"), std::string::npos);
}

TEST(Check, CommentsSuppressInTheirUnitAndUnusedOnesAreReported) {
    MemoryDisk disk = started(kSource, kTarget);
    const std::string edited =
        replaced(kSource, "result * 0.5f;", "result * 0.25f;  // porttool: ignore(source-changed) measured on the GPU");
    disk.files["/r/src/k.cu"] = edited;
    EXPECT_EQ(check(disk)["verdict"], "in_step");
    EXPECT_EQ(check(disk)["summary"]["ignored"], 1);
    disk.files["/r/src/k.cu"] = replaced(edited, "source-changed", "port-differs");
    EXPECT_EQ(rules(check(disk)), (Rules{"source-changed", "unused-suppression"}));
    disk.files["/r/src/k.cu"] =
        std::string(kSource) +
        "// porttool: ignore(unported) a helper of the host\nint host_only(int a) { return a; }\n";
    EXPECT_EQ(check(disk)["verdict"], "in_step");
}

TEST(Check, AnIgnoreOfTheMapThatMatchesNoUnitIsReportedWithItsLine) {
    MemoryDisk disk = started(kSource, kTarget);
    const std::string map = disk.files["/r/portmap.toml"];
    const auto lines = std::count(map.begin(), map.end(), '\n');
    disk.files["/r/portmap.toml"] = map + "[[ignore]]\nid = \"src/k.cu:{gone,lost}\"\nreason = \"host only\"\n" +
                                    "[[ignore]]\nid = \"port/k.comp:lumi*\"\nreason = \"matches a unit of the port\"\n";
    const auto report = check(disk);
    ASSERT_EQ(rules(report), Rules{"unused-suppression"}) << report.dump(1);
    const auto& finding = report["findings"][0];
    EXPECT_EQ(finding["level"], "warning");
    EXPECT_EQ(finding["map_line"], lines + 1);
    EXPECT_NE(finding["message"].get<std::string>().find("src/k.cu:{gone,lost}"), std::string::npos);
    EXPECT_EQ(report["verdict"], "review");
    const std::string text = run(disk, {"-C", "/r", "check"}).out;
    EXPECT_TRUE(text.starts_with("portmap.toml:" + std::to_string(lines + 1) + ": warning: ")) << text;
    EXPECT_EQ(run(disk, {"-C", "/r", "check", "--strict"}).exit_code, 1);
}

TEST(Check, AHazardThatAnEditBringsInIsANote) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] = replaced(kSource, "result * 0.5f", "result * powf(pdf, 0.5f)");
    disk.files["/r/port/k.comp"] = replaced(kTarget, "result * 0.5", "result * pow(pdf, 0.5)");
    const auto report = check(disk);
    ASSERT_EQ(rules(report), Rules{"dialect-hazard"});
    EXPECT_EQ(report["findings"][0]["level"], "note");
    EXPECT_EQ(report["verdict"], "in_step");
}

TEST(Check, SeveralHazardsOfOnePairHaveTheirOwnStableFingerprints) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] = replaced(kSource, "result * 0.5f", "result * powf(pdf, fmodf(pdf, 0.5f))");
    disk.files["/r/port/k.comp"] = replaced(kTarget, "result * 0.5", "result * pow(pdf, mod(pdf, 0.5))");
    auto prints = [&] {
        std::vector<std::string> out;
        const auto report = check(disk);
        for (const auto& finding : report["findings"])
            if (finding["rule"] == "dialect-hazard") out.push_back(finding["fingerprint"]);
        return out;
    };
    const auto before = prints();
    ASSERT_EQ(before.size(), 2u);
    EXPECT_NE(before[0], before[1]);
    disk.files["/r/src/k.cu"] = "// further down\n\n" + disk.files["/r/src/k.cu"];
    EXPECT_EQ(prints(), before);
    for (const std::string& print : before)
        EXPECT_NE(run(disk, {"-C", "/r", "explain", print}).out.find("src/k.cu:shade"), std::string::npos);
}

TEST(Check, ReasonsAreKeptWithTheirDay) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] = replaced(kSource, "result * 0.5f", "result * 0.25f");
    disk.files["/r/src/k.cu"] += "__device__ int fresh(int a) { return a + 1; }\n";
    setenv("SOURCE_DATE_EPOCH", "86400", 1);
    run(disk, {"-C", "/r", "accept", "src/k.cu:shade", "--reason", "the port\tsquares it"});
    unsetenv("SOURCE_DATE_EPOCH");
    run(disk, {"-C", "/r", "ignore", "src/k.cu:fresh", "--reason", "host only"});
    const std::string& lock = disk.files["/r/portmap.lock"];
    EXPECT_NE(lock.find("\t1970-01-02\tthe port squares it\n"), std::string::npos) << lock;
    EXPECT_NE(lock.find("\thost only\n"), std::string::npos) << lock;
    const auto report = check(disk);
    EXPECT_EQ(report["verdict"], "in_step");
    EXPECT_TRUE(report["findings"].empty()) << report.dump(1);
    EXPECT_NE(run(disk, {"-C", "/r", "explain", "src/k.cu:shade"}).out.find("1970-01-02: the port squares it"),
              std::string::npos);
}

TEST(Check, RulesCanBeTurnedDownAndStrictTurnsWarningsUp) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/port/k.comp"] = replaced(kTarget, "result * 0.5", "result * 0.25");
    EXPECT_EQ(run(disk, {"-C", "/r", "check"}).exit_code, 0);
    EXPECT_EQ(run(disk, {"-C", "/r", "check", "--strict"}).exit_code, 1);
    disk.files["/r/portmap.toml"] += "[rules]\n\"target-changed\" = \"off\"\n";
    EXPECT_EQ(check(disk)["verdict"], "in_step");
    EXPECT_TRUE(check(disk)["findings"].empty());
}

}  // namespace
}  // namespace porttool::testing::check_test

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What a file declares of words that a watched function uses, where no pair watches the declaration.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::declared_edit_test {
namespace {

struct Declared {
    std::string from, to;
    std::string declared;  ///< around the function of the source
    std::string use;       ///< what the function says
    Rules rules;           ///< that are no notes
    std::string file = "k.cu";
};

const std::string kMapOf = "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n[[pair]]\n";

/// A function `f` and its port, which never has what the source's file declares, recorded; then `from` becomes `to`.
Rules rules_after(const Declared& row, Side side) {
    MemoryDisk disk;
    const std::string text = row.declared + "\nvoid f(float* o, int n) { o[n] = " + row.use + "; }\n";
    const std::string there = "void f(float* o, int n) { o[n] = other(n); }\n";
    const std::string here_path = side == Side::Source ? "s/" + row.file : "t/" + row.file,
                      there_path = side == Side::Source ? "t/p.cpp" : "s/p.cpp";
    disk.files["/r/" + here_path] = text;
    disk.files["/r/" + there_path] = there;
    const std::string source = side == Side::Source ? here_path : there_path,
                      target = side == Side::Source ? there_path : here_path;
    disk.files["/r/portmap.toml"] = kMapOf + "source = \"" + source + ":f\"\ntarget = \"" + target + ":f\"\n";
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0) << row.declared;
    EXPECT_EQ(check(disk)["findings"].size(), 0u) << row.declared;
    disk.files["/r/" + here_path] = replaced(text, row.from, row.to);
    Rules out;
    const auto report = check(disk);
    for (const auto& finding : report["findings"])
        if (finding["level"] != "note") out.push_back(finding["rule"]);
    return out;
}

TEST(DeclaredEdits, ALocalThatIsRenamedToAWordOfAMacro) {
    const Rules raised = {"source-changed"}, none;
    const std::string gain =
        "#define GAIN (gamma0 * 2.0f)\n#define TWICE GAIN\n#define SQ(x1) ((x1) * (x1).y1)\n"
        "#define rough n\nextern float gamma0;";
    const auto row = [&](const std::string& from, const std::string& to, const std::string& use, const Rules& rules) {
        MemoryDisk disk;
        const auto text = [&](const std::string& local) {
            return gain + "\nvoid f(float* o, int n) { float " + local + " = n; o[n] = " + use + "; o[0] = " + local +
                   "; }\n";
        };
        disk.files["/r/s/k.cu"] = text(from);
        disk.files["/r/t/p.cpp"] = "void f(float* o, int n) { o[n] = other(n); }\n";
        disk.files["/r/portmap.toml"] = kMapOf + "source = \"s/k.cu:f\"\ntarget = \"t/p.cpp:f\"\n";
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        disk.files["/r/s/k.cu"] = text(to);
        Rules out;
        const auto report = check(disk);
        for (const auto& finding : report["findings"])
            if (finding["level"] != "note") out.push_back(finding["rule"]);
        EXPECT_EQ(out, rules) << from << " to " << to << " with " << use;
    };
    row("v", "gamma0", "GAIN", raised);
    row("v", "gamma0", "TWICE", raised);
    row("gamma0", "v", "GAIN", raised);
    row("v", "rough", "1.0f", raised);
    row("v", "w", "GAIN", none);
    row("v", "gamma0", "1.0f", none);
    row("v", "x1", "SQ(o[1])", none);
    row("v", "y1", "SQ(o[1])", none);
}

TEST(DeclaredEdits, OfWordsThatAWatchedFunctionUses) {
    const Rules raised = {"source-changed"}, none;
    const std::string modes = "enum Mode { ADD = 0, MUL = 1, SUB };", kinds = "enum { KIND_A, KIND_B, KIND_C = 4 };",
                      block = "layout(push_constant) uniform PC { float scale; float bias; int n; } pc;",
                      functions = "typedef void (stop_t)(int); typedef void (go_t)(int); typedef void (*at_t)(int);",
                      loose = "layout(std430) buffer Rays { float length; float width; int n2; };";
    const std::vector<Declared> rows = {
        {"= 1", "= 2", modes, "n == MUL", raised},
        {"ADD = 0, MUL = 1", "MUL = 0, ADD = 1", modes, "n == ADD", raised},
        {"MUL = 1", "MUL = 3", modes, "n == SUB", raised},
        {"SUB }", "SUB, DIV }", modes, "n == SUB", none},
        {"MUL = 1", "MUL = 2, SUB2 = 1", modes, "n == ADD", none},
        {"ADD = 0", "ADD", modes, "n == ADD", none},
        {"KIND_C = 4", "KIND_C = 5", kinds, "n == KIND_C", raised},
        {"KIND_A, KIND_B", "KIND_B, KIND_A", kinds, "n == KIND_B", raised},
        {"class Kind", "class Kind", "enum class Kind { A, B };", "n == int(Kind::B)", none},
        {"A, B", "B, A", "enum class Kind { A, B };", "n == int(Kind::B)", raised},
        {"static const", "static volatile const", "static const float gain = 1.5f;", "gain * n", raised},
        {"1.5f", "1.6f", "static const float gain = 1.5f;", "gain * n", raised},
        {"1.5f", "1.50F", "static const float gain = 1.5f;", "gain * n", none},
        {"1.5f", "1.6f", "static const float gain = 1.5f;", "o[0] * n", none},
        {"1.5f", "1.6f", "static const float gain = 1.5f;", "o[0].gain * n", none},
        {"float gain", "double gain", "__constant__ float gain = 1.5f;", "gain * n", raised},
        {"__constant float", "__global float", "__constant float gain = 1.5f;", "gain * n", raised, "k.cl"},
        {"const float", "const mediump float", "const float gain = 1.5;", "gain * n", raised, "k.glsl"},
        {"static uniform", "static", "static uniform float gain = 1.5f;", "gain * n", raised, "k.ispc"},
        {"static const uniform", "static const", "static const uniform float gain = 1.5f;", "gain * n", raised,
         "k.ispc"},
        {"static const float", "static float", "static const float gain = 1.5f;", "gain * n", raised},
        {"1.5f", "1.6f", "static float gain = 1.5f;", "gain * n", raised},
        {"8, 9", "9, 8", "__constant__ int steps[6] = {4, 5, 6, 7, 8, 9};", "steps[n]", raised},
        {"float real", "double real", "typedef float real;", "(real)n", raised},
        {"= float", "= double", "using real = float;", "(real)n", raised},
        {"(go_t)(int)", "(go_t)(float)", functions, "run((go_t*)o, n)", raised},
        {"(go_t)(int)", "(go_t)(float)", functions, "n", none},
        {"(*at_t)(int)", "(*at_t)(float)", functions, "run((at_t)o, n)", raised},
        {"(*at_t)(int)", "(*at_t)(float)", functions, "n", none},
        {"64", "32", "#define STEPS 64", "STEPS * n", raised},
        {"B = 3.0f", "B = 4.0f", "const float B = 3.0f;\nconst float K = B * 2.0f;", "K * n", raised},
        {"B = 3.0f", "B = 4.0f", "const float B = 3.0f;\nconst float K = B * 2.0f;\nfloat L = 1.0f;", "L * n", none},
        {"A 2.0f", "A 4.0f", "#define A 2.0f\nconst float B = 3.0f;\nconst float K = B * A;", "K * n", raised},
        {"float real", "double real", "typedef float real;\ntypedef real scalar;", "(scalar)n", raised},
        {"FIRST = 4", "FIRST = 5", "enum { FIRST = 4, SECOND, LAST = SECOND * 2 };", "LAST * n", raised},
        {"K = 2.0f; } namespace far { const float K = 3.0f", "K = 3.0f; } namespace far { const float K = 2.0f",
         "namespace near { const float K = 2.0f; } namespace far { const float K = 3.0f; }", "near::K * n", raised},
        {"float scale; float bias;", "float bias; float scale;", block, "pc.scale * n", raised, "k.glsl"},
        {"int n;", "uint n;", block, "pc.scale * n", raised, "k.glsl"},
        {"float length; float width;", "float width; float length;", loose, "width * n", raised, "k.glsl"},
    };
    for (const Declared& row : rows) {
        EXPECT_EQ(rules_after(row, Side::Source), row.rules) << row.declared << " " << row.from << " -> " << row.to;
        const Rules of_port = row.rules.empty() ? none : Rules{"target-changed"};
        EXPECT_EQ(rules_after(row, Side::Target), of_port) << row.declared << " " << row.from << " -> " << row.to;
    }
}

/// The findings, as "level rule", of two sides that both declare a constant that no pair watches.
std::vector<std::string> found_after(const std::string& source, const std::string& target,
                                     const BySide<std::string>& now) {
    MemoryDisk disk;
    disk.files = {{"/r/s/k.cu", source},
                  {"/r/t/k.cpp", target},
                  {"/r/portmap.toml", kMapOf + "source = \"s/k.cu:f\"\ntarget = \"t/k.cpp:f\"\n"}};
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
    disk.files["/r/s/k.cu"] = now.source;
    disk.files["/r/t/k.cpp"] = now.target;
    std::vector<std::string> out;
    const auto report = check(disk);
    for (const auto& finding : report["findings"])
        out.push_back(finding["level"].get<std::string>() + " " + finding["rule"].get<std::string>());
    const CommandRun accepted = run(disk, {"-C", "/r", "accept", "--all", "--force"});
    EXPECT_EQ(accepted.exit_code, 0) << accepted.err;
    EXPECT_EQ(check(disk)["findings"].size(), 0u) << "accepted";
    return out;
}

TEST(DeclaredEdits, BothSidesAndPairs) {
    const std::string source =
                          "static const float gain = 1.5f;\nvoid f(float* o, int n) { o[n] = gain * n; }\n"
                          "void g(float* o) { o[0] = gain; }\n",
                      target = "#define AMPLIFY 1.5f\nvoid f(float* o, int n) { o[n] = AMPLIFY * n; }\n";
    using Found = std::vector<std::string>;
    const auto to = [](const std::string& text, const std::string& value) { return replaced(text, "1.5f", value); };
    EXPECT_EQ(found_after(source, target, {to(source, "1.6f"), to(target, "1.6f")}), Found{}) << "the same value";
    EXPECT_EQ(found_after(source, target, {to(source, "1.6f"), target}), Found{"error source-changed"});
    EXPECT_EQ(found_after(source, target, {source, to(target, "1.6f")}), Found{"warning target-changed"});
    EXPECT_EQ(found_after(source, target, {to(source, "1.6f"), to(target, "1.7f")}).size(), 2u);
}

TEST(DeclaredEdits, MacrosWithThePlatformInTheirNames) {
    const auto text = [](const std::string& capitals, const std::string& small, const std::string& call) {
        return "#define CLEAR_" + capitals + " " + call + "_" + small + "(o);\nvoid f(float* o) { CLEAR_" + capitals +
               " }\n";
    };
    using Found = std::vector<std::string>;
    const auto after = [&](const std::string& source, const std::string& target) {
        return found_after(text("CUDA", "cuda", "drop"), text("HIP", "hip", "drop"),
                           {text("CUDA", "cuda", source), text("HIP", "hip", target)});
    };
    EXPECT_EQ(after("give", "give"), Found{});
    EXPECT_EQ(after("give", "keep").size(), 2u);
    EXPECT_EQ(after("give", "drop"), Found{"error source-changed"});
    EXPECT_EQ(found_after(text("CUDA", "cuda", "drop"), text("OTHER", "other", "drop"),
                          {text("CUDA", "cuda", "give"), text("OTHER", "other", "give")})
                  .size(),
              2u)
        << "nothing in the pair's names says that they stand for each other";
}

}  // namespace
}  // namespace porttool::testing::declared_edit_test

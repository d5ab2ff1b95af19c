// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "porttool/measure/measure.h"
#include "porttool/read/map_file.h"
#include "porttool/read/source_files.h"
#include "porttool/scan/scan.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::compare_test {
namespace {

using nlohmann::json;
using testing::read_text;
using testing::replaced;
using testing::run;

const std::string kKernel = R"(// SPDX-License-Identifier: Apache-2.0
#include "math.h"

__device__ inline float3 reflect_ray(float3 direction, float3 normal) {
    float twice = 2.0f * dot(direction, normal);
    return direction - normal * twice;
}

__device__ float schlick(float cosine, float f0) {
    float m = 1.0f - saturate(cosine);
    float m2 = m * m;
    if (m2 < 0.001f) {
        return f0;
    }
    return f0 + (1.0f - f0) * m2 * m2 * m;
}
)";

/// The same in GLSL, laid out otherwise.
const std::string kPort = R"(#version 450
#extension GL_EXT_shader_16bit_storage : require
/* A port.
   Of schlick and reflect_ray. */
vec3 reflect_ray(vec3 direction, vec3 normal)
{
    float twice = 2. * dot(direction, normal);
    return direction
         - normal * twice;
}
float schlick(float cosine, float f0)
{
    float m = 1.0 - saturate(cosine); float m2 = m * m;
    if (m2 < 1e-3) { return f0; }
    return f0 + (1.0 - f0) * m2 * m2 * m;
}
)";

Similarity measured(const std::string& a, const std::string& b, const std::string& path_a = "a.cu",
                    const std::string& path_b = "b.cu") {
    const ScannedFile left = scan_text(path_a, a), right = scan_text(path_b, b);
    return measure({{&left, nullptr}}, {{&right, nullptr}}, Dialect());
}

/// `count` lines of code, 8 tokens each, that no other first number gives.
std::string lines_from(int first, int count) {
    std::string out;
    for (int i = first; i < first + count; ++i) {
        const std::string n = std::to_string(i);
        out += "value_" + n + " = left_" + n + " * right_" + n + " + more_" + n + ";\n";
    }
    return out;
}

// --- what is counted

TEST(Compare, AFileIsLikeItself) {
    const Similarity s = measured(kKernel, kKernel);
    EXPECT_EQ(*s.a.moss_percent, 100);
    EXPECT_EQ(*s.b.moss_percent_blind, 100);
    EXPECT_EQ(*s.a.moss_percent_raw, 100);
    EXPECT_EQ(s.a.shared_lines, s.a.lines);
    EXPECT_EQ(*s.tiling, 1);
    EXPECT_EQ(*s.token_edit, 1);
    EXPECT_EQ(*s.tree_distance, 0);
    EXPECT_EQ(*s.line_divergence, 0);
    EXPECT_TRUE(s.unmeasured.empty());
}

TEST(Compare, AFaithfulPortIsAlikeInTheDialectAndNotAsWritten) {
    const Similarity s = measured(kKernel, kPort, "a.cu", "b.comp");
    EXPECT_EQ(*s.a.moss_percent, 100);
    EXPECT_EQ(*s.b.moss_percent, 100);
    EXPECT_EQ(*s.tiling, 1);
    EXPECT_EQ(*s.token_edit, 1);
    EXPECT_EQ(*s.tree_distance, 0);
    EXPECT_LT(*s.b.moss_percent_raw, 90);
    EXPECT_GT(*s.line_divergence, 0) << "some lines are cut elsewhere";
    EXPECT_EQ(s.a.tokens, s.b.tokens);
}

TEST(Compare, CommentsBlanksAndLineBreaksChangeNothing) {
    const std::string a = kKernel;
    std::string b = replaced(a, "float twice = 2.0f", "float twice /* double */\n\n      = 2.0f");
    b = "// another head\n" + replaced(b, "    }\n    return f0 + ", "    }\n    // Schlick 1994\n    return f0 + ");
    const Similarity s = measured(a, b);
    EXPECT_EQ(*s.a.moss_percent_raw, 100);
    EXPECT_EQ(*s.b.moss_percent, 100);
    EXPECT_EQ(*s.token_edit, 1);
    EXPECT_EQ(s.b.lines, s.a.lines + 1) << "one statement over two lines with code";
}

TEST(Compare, BlindFoldsNamesAndNothingElse) {
    std::string renamed = kKernel;
    for (const auto& [from, to] :
         {std::pair("twice", "t"), {"schlick", "fresnel"}, {"direction", "d"}, {"cosine", "c"}})
        for (size_t at = 0; (at = renamed.find(from, at)) != std::string::npos; at += std::string_view(to).size())
            renamed.replace(at, std::string_view(from).size(), to);
    const Similarity s = measured(kKernel, renamed);
    EXPECT_EQ(*s.a.moss_percent_blind, 100);
    EXPECT_EQ(*s.b.moss_percent_blind, 100);
    EXPECT_LT(*s.a.moss_percent, 70);
    for (const auto& [from, to] :
         {std::pair("2.0f", "3.0f"), {"m * m;", "m + m;"}, {"if (", "while ("}, {"dot", "cross"}}) {
        const Similarity changed = measured(kKernel, replaced(kKernel, from, to));
        EXPECT_LT(*changed.a.moss_percent_blind, 100) << from;
        EXPECT_LT(*changed.a.moss_percent, 100) << from;
        EXPECT_LT(*changed.a.moss_percent_raw, 100) << from;
        EXPECT_LT(*changed.token_edit, 1) << from;
        EXPECT_LT(*changed.tiling, 1) << from;
        EXPECT_GT(*changed.tree_distance, 0) << from;
        EXPECT_GT(*changed.line_divergence, 0) << from;
    }
}

TEST(Compare, BoilerplateCountsOnNeitherSide) {
    const std::string code = lines_from(1, 5);
    const Similarity plain = measured(code, code);
    const std::string guarded =
        "// SPDX-License-Identifier: MIT\n/* Copyright\n   somebody */\n#ifndef A_H\n#define A_H\n"
        "#include <cmath>\n#version 450\n#extension GL_X : enable\n#line 7\n" +
        code + "#endif  // A_H\n";
    const std::string once = "#pragma once\n#include \"x.h\"\n#if 0\nold_1 = old_2 + old_3 * old_4;\n#endif\n" + code;
    const Similarity s = measured(guarded, once);
    EXPECT_EQ(s.a.lines, 5u);
    EXPECT_EQ(s.a.tokens, plain.a.tokens);
    EXPECT_EQ(s.b.lines, 5u);
    EXPECT_EQ(*s.a.moss_percent, 100);
    // A macro with a value is code, and so is a condition that guards no header.
    EXPECT_EQ(measured("#define HALF 0.5f\n" + code, code).a.lines, 6u);
    EXPECT_EQ(measured("#ifndef B\n#define C\n#endif\n" + code, code).a.lines, 8u);
    EXPECT_EQ(measured("#ifndef B\n#define B\n#endif\n" + code + "#ifdef C\nc = 1;\n#endif\n", code).a.lines, 11u);
}

TEST(Compare, TheThesissLinesAreCountedAsItsTableDoes) {
    // Table 2 of the thesis: lines of either side, shared lines, and 1 - (lines not shared) / lines of the CPU side.
    struct Row {
        const char* block;
        int cpu, gpu, shared;
        double degree;
    };
    for (const Row& row : {Row{"Render core", 2007, 800, 181, 0.09},
                           {"BSDF", 100, 141, 73, 0.73},
                           {"Shading", 216, 246, 101, 0.47},
                           {"Extend", 43, 109, 0, 0}}) {
        const std::string shared = lines_from(10'000, row.shared);
        const std::string cpu = lines_from(0, 20) + shared + lines_from(20'000, row.cpu - row.shared - 20);
        const std::string gpu = lines_from(30'000, row.gpu - row.shared - 5) + shared + lines_from(40'000, 5);
        const Similarity s = measured(cpu, gpu);
        EXPECT_EQ(s.a.lines, static_cast<uint32_t>(row.cpu)) << row.block;
        EXPECT_EQ(s.b.lines, static_cast<uint32_t>(row.gpu)) << row.block;
        EXPECT_EQ(s.a.shared_lines, static_cast<uint32_t>(row.shared)) << row.block;
        EXPECT_EQ(s.b.shared_lines, static_cast<uint32_t>(row.shared)) << row.block;
        const double not_shared = s.a.lines - s.a.shared_lines;
        EXPECT_NEAR(1 - not_shared / s.a.lines, row.degree, 0.005) << row.block;
    }
}

TEST(Compare, PercentAndSharedLinesAreTwoFigures) {
    // The worked example of docs/metrics.md. b has one long line more; a shares 3 of 3 lines and b 3 of 4, but the
    // tokens of b are shared by 24 (and the ';' before, which both have not) of 24 + 40.
    const std::string shared = lines_from(1, 3);
    std::string longer = "sum = 0";
    for (int i = 0; i < 18; ++i) longer += " + extra_" + std::to_string(i);
    const Similarity s = measured(shared, longer + ";\n" + shared);
    EXPECT_EQ(s.a.tokens, 24u);
    EXPECT_EQ(s.b.tokens, 64u);
    EXPECT_EQ(*s.a.moss_percent, 100);
    EXPECT_EQ(*s.b.moss_percent, 37.5);
    EXPECT_EQ(s.a.shared_lines, 3u);
    EXPECT_EQ(s.b.shared_lines, 3u);
    EXPECT_EQ(s.b.lines, 4u);
}

TEST(Compare, ALineIsSharedFromHalfOfItsTokensOn) {
    // 24 tokens in common, then a line of 8 of which the first 3 or 4 are common too.
    const std::string head = lines_from(1, 3);
    const Similarity half = measured(head + "x = y + z + w;\n", head + "x = y + other * more;\n");
    EXPECT_EQ(half.a.shared_lines, 4u);
    const Similarity less = measured(head + "x = y + z + w;\n", head + "x = y * other * more;\n");
    EXPECT_EQ(less.a.shared_lines, 3u);
    ASSERT_EQ(less.a_lines.size(), 1u);
    EXPECT_TRUE(less.a_lines[0][2].shared);
    EXPECT_EQ(less.a_lines[0][3].line, 4u);
    EXPECT_FALSE(less.a_lines[0][3].shared);
}

TEST(Compare, NothingMatchesAcrossTheEndsOfFiles) {
    const ScannedFile one = scan_text("one.cu", lines_from(1, 2) + "a = b;\n");
    const ScannedFile two = scan_text("two.cu", "c = d;\n" + lines_from(3, 4));
    const ScannedFile both = scan_text("both.cu", lines_from(1, 2) + "a = b;\nc = d;\n" + lines_from(3, 4));
    // Apart the files have runs of 20 and 36 tokens, together one of 56.
    const Similarity s = measure({{&both, nullptr}}, {{&two, nullptr}, {&one, nullptr}}, Dialect());
    EXPECT_EQ(*s.a.moss_percent, 100);
    EXPECT_EQ(*s.b.moss_percent, 100);
    ASSERT_EQ(s.matches.size(), 2u);
    EXPECT_EQ(s.matches[0].a, (ExcerptLines{0, 1, 3}));
    EXPECT_EQ(s.matches[0].b, (ExcerptLines{1, 1, 3}));
    EXPECT_EQ(s.matches[1].a, (ExcerptLines{0, 4, 8}));
    EXPECT_EQ(s.matches[1].b, (ExcerptLines{0, 1, 5}));
    // Many pieces without room for one match are too short, however many.
    const ScannedFile piece = scan_text("piece.cu", lines_from(1, 2));
    const Similarity pieces = measure({{&both, nullptr}}, Passage(50, {&piece, nullptr}), Dialect());
    EXPECT_FALSE(pieces.b.moss_percent);
    EXPECT_EQ(pieces.unmeasured.at("moss_percent"), "too short: b has 16 tokens in one piece, 19 are needed");
}

TEST(Compare, MembersAreNotPartOfTheirClass) {
    const ScannedFile file =
        scan_text("a.h", "struct Big {\n    int x;\n    void grow() { " + lines_from(1, 9) + " }\n};\n");
    const auto unit = std::find_if(file.units.begin(), file.units.end(), [](const Unit& u) { return u.name == "Big"; });
    ASSERT_NE(unit, file.units.end());
    EXPECT_EQ(code_lines({&file, &*unit}), (std::vector<uint32_t>{1, 2, 13}));
    EXPECT_EQ(code_stretches({&file, &*unit}).size(), 2u);
    const std::string small =
        "struct Pair {\n    float first_of_two, second_of_two;\n    float sum() const { return 1; }\n"
        "    float third, fourth, fifth, sixth, seventh;\n};\n";
    const ScannedFile pair = scan_text("p.h", small);
    const Passage rest = {{&pair, &pair.units.front()}};
    EXPECT_EQ(*measure(rest, rest, Dialect()).a.moss_percent, 100) << "what is left of a class is one piece";
}

TEST(Compare, ExchangingTheSidesExchangesTheFigures) {
    // Figures must not depend on which side's words are numbered first, nor on where files begin.
    const std::filesystem::path folder = std::filesystem::path(REPOSITORY) / "porttool" / "scan";
    std::vector<ScannedFile> files;
    for (const char* name : {"head.cpp", "units.cpp", "constants.cpp", "branches.cpp"})
        files.push_back(scan_text(name, read_text(folder / name)));
    const Passage a = {{&files[0], nullptr}, {&files[1], nullptr}}, b = {{&files[2], nullptr}, {&files[3], nullptr}};
    const Similarity there = measure(a, b, Dialect()), back = measure(b, a, Dialect());
    EXPECT_GT(*there.a.moss_percent_blind, 0);
    EXPECT_LT(*there.a.moss_percent_blind, 60);
    for (const auto& [x, y] : {std::pair(there.a, back.b), {there.b, back.a}}) {
        EXPECT_EQ(x.moss_percent, y.moss_percent);
        EXPECT_EQ(x.moss_percent_blind, y.moss_percent_blind);
        EXPECT_EQ(x.moss_percent_raw, y.moss_percent_raw);
        EXPECT_EQ(x.shared_lines, y.shared_lines);
    }
    EXPECT_EQ(there.token_edit, back.token_edit);
    EXPECT_EQ(there.tree_distance, back.tree_distance);
    EXPECT_EQ(there.line_divergence, back.line_divergence);
}

TEST(Compare, TheTreeSeesBlocksAndNotTheirLayout) {
    const std::string flat = "void f(int a) { if (a > 0) b = a * 2 + c; else b = c; d = b * b - 4 * a * c; e = 7; }";
    const std::string braces =
        "void g(int a)\n{\n if (a > 0) { b = a * 2 + c; }\n else { b = c; }\n d = b * b - 4 * a * c;\n e = 7;\n}";
    EXPECT_EQ(*measured(flat, braces).tree_distance, 0) << "the name of the unit itself makes no difference";
    // Moving `e = 7;` into the else costs one deletion and one insertion in trees of 9 nodes each: root, f, if, b,
    // else, b, d, e make 8 and 8.
    const std::string moved =
        "void f(int a) { if (a > 0) b = a * 2 + c; else { b = c; e = 7; } d = b * b - 4 * a * c; }";
    EXPECT_DOUBLE_EQ(*measured(flat, moved).tree_distance, 2.0 * 2 / (8 + 8 + 2));
}

TEST(Compare, AStatementThatLeavesItsBlockIsAnotherTree) {
    // Only a brace moves; c = 2 is deleted below the if and inserted beside it.
    const std::string inside = "void f(int a) { if (a > 0) { b = 1; c = 2; } d = b * b - 4 * a * c; }";
    const std::string outside = "void f(int a) { if (a > 0) { b = 1; } c = 2; d = b * b - 4 * a * c; }";
    EXPECT_DOUBLE_EQ(*measured(inside, outside).tree_distance, 2.0 * 2 / (6 + 6 + 2));
}

TEST(Compare, ScopesAndWordsWithoutCounterpartAreNoDifference) {
    const std::string plain = "float f(float x) { float y = max(x, 1.0f); return x * y + y * weight(x, y); }\n";
    const std::string scoped =
        "inline\nfloat f(const float x) { float y = std::max(x, 1.0f); return x * y + y * n::weight(x, y); }\n";
    const Similarity s = measured(plain, scoped);
    EXPECT_EQ(*s.b.moss_percent, 100);
    EXPECT_EQ(s.b.tokens, s.a.tokens);
    EXPECT_LT(*s.b.moss_percent_raw, 100);
    // The line with `inline` alone goes with the next one.
    EXPECT_EQ(s.b.lines, 2u);
    EXPECT_EQ(s.b.shared_lines, 2u);
    const Similarity none = measured(lines_from(1, 4), lines_from(7, 1) + scoped);
    EXPECT_EQ(none.b.shared_lines, 0u);
}

// --- the command

MemoryDisk files(const std::map<std::string, std::string>& texts) {
    MemoryDisk disk;
    for (const auto& [path, text] : texts) disk.files["/r/" + path] = text;
    return disk;
}

TEST(CompareCommand, PrintsTheContractsFields) {
    MemoryDisk disk = files({{"src/a.cu", kKernel}, {"port/b.comp", kPort}});
    const auto done = run(disk, {"-C", "/r", "compare", "src/a.cu", "port/b.comp", "--format", "json"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const json out = json::parse(done.out);
    EXPECT_EQ(out["a"]["id"], "src/a.cu:@file");
    EXPECT_EQ(out["a"]["lines"], 12);
    EXPECT_EQ(out["b"]["lines"], 12);
    EXPECT_EQ(out["a"]["tokens"], out["b"]["tokens"]);
    EXPECT_EQ(out["shared_lines_a"], 12);
    EXPECT_EQ(out["shared_lines_b"], 12);
    for (const char* name : {"moss_percent_a", "moss_percent_b", "moss_percent_blind_a", "moss_percent_blind_b"})
        EXPECT_EQ(out[name], 100.0) << name;
    for (const char* name :
         {"moss_percent_raw_a", "moss_percent_raw_b", "tiling", "tree_distance", "line_divergence", "token_edit"})
        EXPECT_TRUE(out[name].is_number()) << name;
    EXPECT_EQ(out["parameters"]["k"], 12);
    EXPECT_EQ(out["parameters"]["w"], 8);
    ASSERT_EQ(out["matches"].size(), 1u);
    EXPECT_EQ(out["matches"][0]["a"], json::array({4, 16}));
    EXPECT_EQ(out["matches"][0]["b"], json::array({5, 16}));
    EXPECT_NE(run(disk, {"-C", "/r", "compare", "src/a.cu", "port/b.comp"}).out.find("k = 12 tokens, w = 8"),
              std::string::npos);
}

TEST(CompareCommand, TakesUnitsAndFindsThemFromAFolderAndFromTheRoot) {
    MemoryDisk disk = files({{"src/a.cu", kKernel},
                             {"port/b.comp", kPort},
                             {"portmap.toml", "version = 1\n"},
                             {"src/c:d.h", "namespace n { " + kKernel + " }"}});
    const auto id_a = [&](const std::string& folder, const std::string& a) {
        const auto done = run(disk, {"-C", folder, "compare", a, "port/b.comp:schlick", "--format", "json"});
        return done.exit_code == 0 ? json::parse(done.out)["a"]["id"].get<std::string>() : done.err;
    };
    EXPECT_EQ(id_a("/r", "src/a.cu:schlick"), "src/a.cu:schlick");
    EXPECT_EQ(id_a("/r/src", "a.cu:schlick"), "src/a.cu:schlick");
    EXPECT_EQ(id_a("/r/src", "src/a.cu:schlick"), "src/a.cu:schlick") << "an id as scan prints it";
    EXPECT_EQ(id_a("/r", "/r/src/a.cu:@file"), "src/a.cu:@file");
    EXPECT_EQ(id_a("/r", "src/c:d.h:n::schlick"), "src/c:d.h:n::schlick") << "the longest part that is a file";
    EXPECT_EQ(id_a("/r", "src/c:d.h"), "src/c:d.h:@file");
}

TEST(CompareCommand, TheMapsDialectCounts) {
    const std::string a =
        "Spectrum f(Spectrum x) { Spectrum y = x * x + x; Spectrum z = y * x - y; return z * y * y; }";
    std::string b = a;
    for (size_t at = 0; (at = b.find("Spectrum", at)) != std::string::npos;) b.replace(at, 8, "rgb");
    MemoryDisk disk = files({{"a.cu", a}, {"b.cu", b}});
    const std::vector<std::string> line = {"-C", "/r", "compare", "a.cu", "b.cu", "--format", "json"};
    disk.files["/r/portmap.toml"] = "version = 1\n";
    EXPECT_LT(json::parse(run(disk, line).out)["moss_percent_a"], 100);
    disk.files["/r/portmap.toml"] = "version = 1\n[dialect]\n\"Spectrum\" = \"rgb\"\n";
    EXPECT_EQ(json::parse(run(disk, line).out)["moss_percent_a"], 100);
}

TEST(CompareCommand, TooShortIsSaidAndNull) {
    MemoryDisk disk =
        files({{"tiny.cu", "int x;\n"}, {"empty.cu", ""}, {"head.cu", "// only a comment\n"}, {"a.cu", kKernel}});
    const auto figures = {
        "moss_percent_a",     "moss_percent_b", "moss_percent_blind_a", "moss_percent_blind_b", "moss_percent_raw_a",
        "moss_percent_raw_b", "tiling",         "token_edit",           "tree_distance",        "line_divergence",
        "shared_lines_a"};
    for (const auto& [a, b, reason] : {std::array{"tiny.cu", "tiny.cu", "too short: a has 3 tokens, 19 are needed"},
                                       {"a.cu", "tiny.cu", "too short: b has 3 tokens, 19 are needed"},
                                       {"empty.cu", "a.cu", "too short: a has no code"},
                                       {"head.cu", "empty.cu", "too short: a has no code"}}) {
        const auto done = run(disk, {"-C", "/r", "compare", a, b, "--format", "json"});
        ASSERT_EQ(done.exit_code, 0) << done.err;
        const json out = json::parse(done.out);
        for (const char* name : figures) EXPECT_TRUE(out[name].is_null()) << a << " " << name;
        EXPECT_TRUE(out["matches"].empty());
        EXPECT_NE(run(disk, {"-C", "/r", "compare", a, b}).out.find(reason), std::string::npos) << a << " and " << b;
    }
}

TEST(CompareCommand, BadInputIsRefusedByName) {
    MemoryDisk disk = files({{"a.cu", kKernel}, {"folder/b.cu", kKernel}, {"binary.cu", std::string("a\0b", 3)}});
    const auto error = [&](const std::string& a, const std::string& b) {
        const auto done = run(disk, {"-C", "/r", "compare", a, b});
        EXPECT_EQ(done.exit_code, 2) << a << " and " << b;
        EXPECT_TRUE(done.out.empty());
        return done.err;
    };
    EXPECT_EQ(error("a.cu", "binary.cu"), "porttool: binary.cu: is binary: byte 1 is NUL\n");
    EXPECT_EQ(
        error("gone.cu", "a.cu"),
        "porttool: gone.cu: no such file or unit; paths are relative to -C or to the root, units are PATH:NAME\n");
    EXPECT_EQ(error("a.cu", "folder"), "porttool: folder is a folder; name a file, or a unit as PATH:NAME\n");
    EXPECT_EQ(error("a.cu:schlik", "a.cu"),
              "porttool: a.cu has no unit 'schlik'; did you mean 'schlick'?\nporttool scan a.cu lists its 2 units\n");
    EXPECT_EQ(error("a.cu:n::reflect_ray", "a.cu"),
              "porttool: a.cu has no unit 'n::reflect_ray'; did you mean 'reflect_ray'?\n"
              "porttool scan a.cu lists its 2 units\n");
    EXPECT_EQ(run(disk, {"-C", "/r", "compare", "a.cu"}).exit_code, 2);
    EXPECT_EQ(run(disk, {"-C", "/r", "compare", "a.cu", "a.cu", "--format", "html"}).exit_code, 2);
}

TEST(CompareCommand, OneGiantFunctionIsMeasuredAsFarAsItsLengthAllows) {
    std::string giant = "void f() {\n" + lines_from(0, 20'000) + "}\n";
    MemoryDisk disk = files({{"a.cu", giant}, {"b.cu", replaced(giant, "value_10000 ", "other ")}});
    const auto done = run(disk, {"-C", "/r", "compare", "a.cu:f", "b.cu:f", "--format", "json"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const json out = json::parse(done.out);
    EXPECT_EQ(out["a"]["lines"], 20'002);
    EXPECT_EQ(out["shared_lines_a"], 20'002);
    EXPECT_NEAR(out["moss_percent_a"], 100 * (1 - 1.0 / 160'006), 1e-9);
    EXPECT_EQ(out["matches"].size(), 2u);
    EXPECT_TRUE(out["tiling"].is_null());
    EXPECT_EQ(out["unmeasured"]["tiling"], "too long: 160006 tokens, at most 100000");
}

// --- another program's opinion

/// Ranks from 0 on; equal values share the mean of theirs.
std::vector<double> ranks(const std::vector<double>& values) {
    std::vector<double> out;
    for (const double value : values) {
        const auto less = std::count_if(values.begin(), values.end(), [&](double v) { return v < value; });
        const auto same = std::count(values.begin(), values.end(), value);
        out.push_back(static_cast<double>(less) + static_cast<double>(same - 1) / 2);
    }
    return out;
}

/// Spearman's rank correlation.
double rank_agreement(const std::vector<double>& x, const std::vector<double>& y) {
    const std::vector<double> a = ranks(x), b = ranks(y);
    const double mean = static_cast<double>(a.size() - 1) / 2;
    double ab = 0, aa = 0, bb = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - mean) * (b[i] - mean);
        aa += (a[i] - mean) * (a[i] - mean);
        bb += (b[i] - mean) * (b[i] - mean);
    }
    return ab / std::sqrt(aa * bb);
}

/// A file of 40 functions of random statements. The first `kept` are the same in each file but for their names.
std::string functions(unsigned kept, unsigned file) {
    std::string out;
    for (unsigned at = 0; at < 40; ++at) {
        std::mt19937 dice(at < kept ? at : 1000 * (file + 1) + at);
        const std::string name = "name" + std::to_string(file);
        out += "float " + name + "_f(float x) {\n";
        const std::array<const char*, 12> operators = {" + ", " - ", " * ", " / ", " % ",  " & ",
                                                       " | ", " ^ ", " < ", " > ", " && ", " || "};
        const unsigned statements = 4 + dice() % 8;
        for (unsigned i = 0; i < statements; ++i) {
            out += dice() % 4 == 0 ? "    if (x) x = " : "    float y = ";
            for (unsigned term = 2 + dice() % 8; term > 0; --term)
                out += (dice() % 3 == 0 ? "f(" + name + ")" : name) + operators[dice() % operators.size()];
            out += "x;\n";
        }
        out += "}\n";
    }
    return out;
}

/// What share of file a sim_c++ finds in file b, in percent.
double sim_percent(const std::string& a, const std::string& b) {
    const std::string command = "sim_c++ -p -e -t 1 -r 19 '" + a + "' '" + b + "'";
    FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 4096> line{};
    double found = 0;
    while (std::fgets(line.data(), line.size(), pipe) != nullptr) {
        const std::string text = line.data();
        const std::string start = a + " consists for ";
        if (text.starts_with(start)) found = std::max(found, std::strtod(text.c_str() + start.size(), nullptr));
    }
    pclose(pipe);
    return found;
}

TEST(Compare, RanksPairsAsSimDoes) {
    if (std::system("command -v sim_c++ >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "no sim_c++; apt install similarity-tester";
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("porttool_sim_pairs_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const std::string base = functions(40, 0);
    std::vector<double> ours, theirs;
    for (unsigned kept = 0; kept <= 40; kept += 4) {
        const std::string other = functions(kept, kept + 1);
        const std::string a = (folder / "a.cpp").string(),
                          b = (folder / ("b" + std::to_string(kept) + ".cpp")).string();
        std::ofstream(a) << base;
        std::ofstream(b) << other;
        ours.push_back(*measured(base, other, "a.cpp", "b.cpp").a.moss_percent_blind);
        theirs.push_back(sim_percent(a, b));
    }
    std::filesystem::remove_all(folder);
    EXPECT_GE(rank_agreement(ours, theirs), 0.95);
    EXPECT_GE(theirs.back(), 95);
    EXPECT_EQ(ours.back(), 100);
}

// --- our own cores

std::vector<ScannedFile> scanned(const std::vector<std::string>& globs) {
    const RealDisk disk;
    std::vector<std::string> unmatched;
    std::vector<ScannedFile> files;
    for (const SourceText& source : read_globs(disk, REPOSITORY, globs, unmatched).files)
        files.push_back(scan_text(source.path, source.text));
    EXPECT_TRUE(unmatched.empty());
    return files;
}

Passage passage_of(const std::vector<ScannedFile>& files) {
    Passage out;
    for (const ScannedFile& file : files) out.push_back({&file, nullptr});
    return out;
}

std::map<std::string, Similarity> own_blocks() {
    const std::filesystem::path folder = REPOSITORY;
    const MapFile map = read_map("portmap.toml", read_text(folder / "portmap.toml")).map;
    std::map<std::string, Similarity> out;
    for (const MapBlock& block : map.blocks) {
        const std::vector<ScannedFile> source = scanned(block.source), target = scanned(block.target);
        out[block.name] = measure_shares(passage_of(source), passage_of(target), Dialect(map.dialect));
    }
    return out;
}

TEST(Compare, OwnBlocksShareWhatTheyShould) {
    const std::map<std::string, Similarity> blocks = own_blocks();
    for (const auto& [name, s] : blocks)
        std::printf(
            "%-12s source %4u lines %4u shared %5.1f %%  target %4u lines %4u shared %5.1f %%  blind %5.1f raw %5.1f\n",
            name.c_str(), s.a.lines, s.a.shared_lines, *s.a.moss_percent, s.b.lines, s.b.shared_lines,
            *s.b.moss_percent, *s.b.moss_percent_blind, *s.b.moss_percent_raw);
    EXPECT_GE(*blocks.at("BSDF").b.moss_percent, 90);
    EXPECT_GE(*blocks.at("Shading").b.moss_percent, 80);
    EXPECT_GE(*blocks.at("Extend kernels").b.moss_percent, 50);
    EXPECT_GE(*blocks.at("Kernels").b.moss_percent, 80);
    // Everything, with the device's tree and Embree beside it, is much less alike.
    EXPECT_LT(*blocks.at("Render core").b.moss_percent, 60);
}

TEST(Compare, OneTokenOfManyIsNotRoundedAway) {
    std::string text = "float f(float x) {\n";
    for (int i = 0; i < 3000; ++i) text += "  x = x * " + std::to_string(i) + ".5 + x;\n";
    MemoryDisk disk;
    disk.files = {{"/r/a.comp", text + "  return x + 1;\n}\n"}, {"/r/b.comp", text + "  return x - 1;\n}\n"}};
    const std::string out = run(disk, {"-C", "/r", "compare", "a.comp", "b.comp"}).out;
    EXPECT_EQ(out.find("100.0"), std::string::npos) << out;
    EXPECT_EQ(out.find("1.000"), std::string::npos) << out;
    EXPECT_NE(out.find("99.9"), std::string::npos) << out;
    EXPECT_NE(out.find("0.999"), std::string::npos) << out;
    EXPECT_NE(run(disk, {"-C", "/r", "compare", "a.comp", "a.comp"}).out.find("100.0"), std::string::npos);
}

}  // namespace
}  // namespace porttool::compare_test

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Edits that most likely need no port, labelled by hand, each beside one like it that does: the first are notes, the
// second stay errors.
#include <gtest/gtest.h>

#include "porttool/compare/asides.h"
#include "porttool/compare/side_edit.h"
#include "porttool/compare/switch_cases.h"
#include "porttool/scan/side.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::weighed_edit_test {
namespace {

struct Weighed {
    std::string what;
    BySide<std::string> before, now;
    Rules rules;  ///< that are no notes
};

/// A CUDA kernel `f` and its port in C++, recorded with the texts before and checked with those of now.
Rules open_rules(const Weighed& row) {
    MemoryDisk disk;
    disk.files = {{"/r/s/k.cu", row.before.source},
                  {"/r/t/k.cpp", row.before.target},
                  {"/r/portmap.toml",
                   "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
                   "[[pair]]\nsource = \"s/k.cu:f\"\ntarget = \"t/k.cpp:f\"\n"}};
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0) << row.what;
    disk.files["/r/s/k.cu"] = row.now.source;
    disk.files["/r/t/k.cpp"] = row.now.target;
    Rules out;
    const auto report = check(disk);
    for (const auto& finding : report["findings"])
        if (finding["level"] != "note") out.push_back(finding["rule"]);
    return out;
}

void expect_all(const std::vector<Weighed>& rows) {
    for (const Weighed& row : rows) EXPECT_EQ(open_rules(row), row.rules) << row.what;
}

const BySide<std::string> kCopy = {
    "void f(float* y, const float* x, float lim, int n) {\n"
    "  const int at = first_index(); const int out = 3 * at;\n"
    "  if (at >= n) { return; }\n  y[out] = x[at];\n  y[out + 1] = lim;\n}\n",
    "void f(span y, span x, float lim, int n) {\n"
    "  for (int at = 0; at < n; ++at) { const int out = 3 * at;\n"
    "    y.store(out, x.load(at));\n    y.store(out + 1, lim);\n  }\n}\n"};

BySide<std::string> copy_with(const std::string& from_source, const std::string& to_source,
                              const std::string& from_target, const std::string& to_target) {
    return {replaced(kCopy.source, from_source, to_source), replaced(kCopy.target, from_target, to_target)};
}

TEST(WeighedEdit, BracketsCastsAndTypesOfWhatCameInOwnWords) {
    const BySide<std::string> was = {
        "void f(float* p, const int* e, int n, int m, float lim) {\n  int i = first_index();\n  if (i >= n) return;\n"
        "  float x = p[i];\n  for (int j = 0; j < m; ++j) { x = x * 0.5f + e[j]; }\n  p[i] = x;\n}\n",
        "void f(std::vector<float>& p, std::vector<int>& e, float lim) {\n  for (size_t i = 0; i < p.size(); ++i) {\n"
        "    float x = p[i];\n    for (int j : e) { x = x * 0.5f + j; }\n    p[i] = x;\n  }\n}\n"};
    const std::string at = "float x = p[i];";
    const auto row = [&](const std::string& source, const std::string& target, const Rules& rules) {
        return Weighed{source + " / " + target,
                       was,
                       {replaced(was.source, at, at + " " + source), replaced(was.target, at, at + " " + target)},
                       rules};
    };
    const Rules told = {"port-differs"};
    expect_all({
        row("x = lim / (x * 0.25f);", "x = lim / x * 0.25f;", told),
        row("x = lim - (x - 0.25f);", "x = lim - x - 0.25f;", told),
        row("x = -(x + lim) + 0.25f;", "x = -x + lim + 0.25f;", told),
        row("if (!(x > lim && x < 0.25f)) x = lim;", "if (!(x > lim) && x < 0.25f) x = lim;", told),
        row("x = min(x, lim) + 0.25f;", "x = min(x, lim + 0.25f);", told),
        row("x = x + p[i + 1];", "x = x + p[i] + 1;", told),
        row("int q = (int)(x * lim); x = q * 0.5f;", "int q = (int)x * lim; x = q * 0.5f;", told),
        row("x = (float)(i + 1) * lim;", "x = (float)i + 1 * lim;", told),
        row("x = (x > lim ? lim : x) * 0.5f;", "x = x > lim ? lim : x * 0.5f;", told),
        row("x = (float)((int)(x * lim)) + 0.5f;", "x = (float)((double)(x * lim)) + 0.5f;", told),
        row("int q = x * lim; x = q * 0.5f;", "float q = x * lim; x = q * 0.5f;", told),
        row("float& q = p[i]; q = x * lim;", "float q = p[i]; q = x * lim;", told),
    });
}

TEST(WeighedEdit, AnotherTypeBesideOneEditOfBothSides) {
    const BySide<std::string> was = {
        "uint32_t f(uint32_t x, float scale) {\n  uint32_t h = x;\n  for (int k = 0; k < 3; ++k) { h ^= h >> 16; }\n"
        "  float r = h * scale;\n  return h + r;\n}\n",
        "std::uint32_t f(std::uint32_t bits, float unit) {\n  std::uint32_t value = bits;\n  #pragma omp critical\n"
        "  for (int t = 0; t < 3; ++t) { value ^= value >> 16; }\n"
        "  float real = value * unit;\n  return value + real;\n}\n"};
    struct OfBoth {
        std::string what, from_source, to_source, from_target, to_target;
    };
    const std::vector<OfBoth> edits = {
        {"a statement", "float r =", "h += 7u; float r =", "float real =", "value += 7u; float real ="},
        {"two", "float r =", "h *= 5u; h ^= h >> 3; float r =", "float real =",
         "value *= 5u; value ^= value >> 3; float real ="},
        {"a number", ">> 16", ">> 15", ">> 16", ">> 15"},
        {"a loss", "h ^= h >> 16;", "", "value ^= value >> 16;", ""},
    };
    const std::vector<std::pair<std::string, std::string>> beside = {
        {"(std::uint32_t bits", "(std::int32_t bits"},
        {"(std::uint32_t bits", "(std::uint64_t bits"},
        {"(std::uint32_t bits", "(std::uint32_t& bits"},
        {"std::uint32_t f(", "std::int32_t f("},
        {"std::uint32_t f(", "std::uint8_t f("},
        {"float unit", "double unit"},
        {"std::uint32_t value", "std::int32_t value"},
        {"float real", "int real"},
        {"  #pragma omp critical\n", ""},
        {"omp critical", "omp parallel for"},
    };
    for (const OfBoth& edit : edits) {
        const BySide<std::string> now = {replaced(was.source, edit.from_source, edit.to_source),
                                         replaced(was.target, edit.from_target, edit.to_target)};
        expect_all({{edit.what, was, now, {}}});
        for (const auto& [from, to] : beside) {
            const BySide<std::string> other = {now.source, replaced(now.target, from, to)};
            expect_all({{edit.what + ", beside " + to, was, other, {"port-differs"}}});
        }
    }
}

TEST(WeighedEdit, WhatCameInOwnWordsContradictsThePair) {
    const BySide<std::string> was = {
        "float f(const float* rgb, int n, float gain, float bias) {\n  float light = 0.0f;\n  float clear = 1.0f;\n"
        "  for (int k = 0; k < n; ++k) { const float t = rgb[k] * gain; light += t * clear; clear *= bias; }\n"
        "  if (light > gain) { light = gain; }\n  clear = clear * gain;\n  return light + clear * bias;\n}\n",
        "float f(std::span<const float> tint, float factor, float shift) {\n  float sum = 0.0f;\n  float left = 1.0f;\n"
        "  for (const float each : tint) { const float way = each * factor; sum += way * left; left *= shift; }\n"
        "  if (sum > factor) { sum = factor; }\n  left = left * factor;\n  return sum + left * shift;\n}\n"};
    const auto row = [&](const std::string& source, const std::string& target) {
        return Weighed{source + " / " + target,
                       was,
                       {replaced(was.source, "return light", source + " return light"),
                        replaced(was.target, "return sum", target + " return sum")},
                       {"port-differs"}};
    };
    const std::string block = "if (clear < 0.5f) { light += 1; clear = 0.5f; }";
    expect_all({
        row(block, "if (left < 0.5f) { left += 1; left = 0.5f; }"),
        row(block, "if (left < 0.5f) { sum += 1; sum = 0.5f; }"),
        row(block, "if (sum < 0.5f) { sum += 1; left = 0.5f; }"),
        row(block, "if (left <= 0.5f) { sum += 1; left = 0.5f; }"),
        row("light = light * 0.5f + gain * 0.25f; clear = clear * 0.75f + light;",
            "sum = sum * 0.5f + left * 0.25f; left = left * 0.75f + sum;"),
        row("light = light * 0.5f + gain * 0.25f; clear = clear * 0.75f + light;",
            "sum = sum * 0.5f + factor * 0.25f; left = left * (0.75f + sum);"),
        row("light = fminf(fmaxf(light, 0.0f), gain);", "sum = std::max(std::min(sum, 0.0f), factor);"),
        row("light = light - gain - bias;", "sum = sum - (factor - shift);"),
        row("light = light / gain * bias;", "sum = sum / (factor * shift);"),
        row("float q = light * 3.0f; light += q * gain;", "int q = sum * 3.0f; sum += q * factor;"),
        row("for (int j = 0; j < n; ++j) { light += gain; }", "for (float j = 0; j < n; ++j) { sum += factor; }"),
    });
}

TEST(WeighedEdit, AnArmThatSaysAnotherThingThanTheOthers) {
    const std::string head = "float f(int k, float x, float y) {\n  switch (k) {\n    case ADD: return x + y;\n";
    const std::string tail = "  }\n  return 0.0f;\n}\n";
    const BySide<std::string> was = {head + tail,
                                     head + "    case MUL: return x * y;\n    case DIV: return x / y;\n" + tail};
    const auto with = [&](const std::string& arm) { return BySide<std::string>{head + arm + tail, was.target}; };
    const Rules told = {"source-changed"};
    expect_all({{"the same", was, with("case MUL: return x * y;\n"), {}},
                {"another sign", was, with("case MUL: return x + y;\n"), told},
                {"operands the other way round", was, with("case DIV: return y / x;\n"), told},
                {"a number more", was, with("case MUL: return x * y * 2.0f;\n"), told},
                {"left otherwise", was, with("case MUL: x = x * y; break;\n"), told}});
}

TEST(WeighedEdit, BothSidesInTheirOwnWords) {
    const std::string from = "y[out] = x[at];", to = "y[out] = min(x[at] * 0.5f - shift(at), lim);";
    const std::string there = "y.store(out, x.load(at));";
    expect_all({
        {"one edit in two manners",
         kCopy,
         copy_with(from, to, there, "y.store(out, std::min(x.load(at) * 0.5f - shift(at), lim));"),
         {}},
        {"another number",
         kCopy,
         copy_with(from, to, there, "y.store(out, std::min(x.load(at) * 0.25f - shift(at), lim));"),
         {"port-differs"}},
        {"another sign",
         kCopy,
         copy_with(from, to, there, "y.store(out, std::min(x.load(at) + 0.5f - shift(at), lim));"),
         {"port-differs"}},
        {"half of the edit",
         kCopy,
         copy_with(from, to, there, "y.store(out, x.load(at) * 0.5f - shift(at));"),
         {"port-differs"}},
        {"another function",
         kCopy,
         copy_with(from, to, there, "y.store(out, std::max(x.load(at) * 0.5f - shift(at), lim));"),
         {"port-differs"}},
        {"a name of both sides in another's place",
         kCopy,
         copy_with(from, to, there, "y.store(out, std::min(x.load(at) * 0.5f - shift(out), lim));"),
         {"port-differs"}},
        {"the same at the end",
         kCopy,
         copy_with(from, to, there, "y.store(out, std::min(x.load(at) * 0.5f - shift(at), n));"),
         {"port-differs"}},
        {"a condition on one side",
         kCopy,
         copy_with(from, to, there, "if (at > out) { y.store(out, std::min(x.load(at) * 0.5f - shift(at), lim)); }"),
         {"port-differs"}},
    });
}

TEST(WeighedEdit, WhatCameIsTheSameAndOwnWordsWentTogether) {
    const BySide<std::string> before = {
        "void f(float* p, int k, float a) {\n  float r;\n"
        "  if (k > 2) { p[0] = a; p[1] = a * 3.0f; } else { r = 0.25f; p[0] = r; }\n}\n",
        "void f(float* p, int k, float a) {\n  float out[1];\n"
        "  if (k > 2) { p[0] = a; p[1] = a * 3.0f; } else { * out = 0.25f; p[0] = out[0]; }\n}\n"};
    const std::string old_source = "r = 0.25f; p[0] = r;", old_target = "* out = 0.25f; p[0] = out[0];";
    const auto now = [&](const std::string& source, const std::string& target) {
        return BySide<std::string>{replaced(before.source, old_source, source),
                                   replaced(before.target, old_target, target)};
    };
    expect_all({
        {"gone on both sides", before, now("p[0] = -a;", "p[0] = -a;"), {}},
        {"gone on one side", before, now("p[0] = -a;", "* out = 0.25f; p[0] = -a;"), {"port-differs"}},
        {"something else came", before, now("p[0] = -a;", "p[0] = a;"), {"port-differs"}},
        {"more came", before, now("p[0] = -a;", "p[0] = -a; p[1] = a;"), {"port-differs"}},
        {"what both had went on one side",
         before,
         {replaced(now("p[0] = -a;", "").source, "p[1] = a * 3.0f;", ""), now("", "p[0] = -a;").target},
         {"port-differs"}},
    });
}

TEST(WeighedEdit, OwnWordsThatStoodForNothingMayGo) {
    const BySide<std::string> before = {
        "void f(float* p, int k, float a) {\n  p[0] = a;\n  p[1] = a * 3.0f;\n  p[2] = k;\n  flush(p);\n}\n",
        "void f(float* p, int k, float a) {\n  p[0] = a;\n  sweep(k);\n  p[1] = a * 3.0f;\n  p[2] = k;\n"
        "  Sink sink(p); sink.drain();\n}\n"};
    const std::string more = "p[2] = k; p[3] = -a;";
    const auto now = [&](const std::string& from, const std::string& to) {
        return BySide<std::string>{replaced(before.source, "p[2] = k;", more),
                                   replaced(replaced(before.target, "p[2] = k;", more), from, to)};
    };
    expect_all({
        {"the source has nothing there", before, now("  sweep(k);\n", ""), {}},
        {"the source has it in its words", before, now("  Sink sink(p); sink.drain();\n", ""), {"port-differs"}},
        {"what both have went, too", before, now("  sweep(k);\n  p[1] = a * 3.0f;\n", ""), {"port-differs"}},
        {"another came in its place", before, now("sweep(k);", "sweep(a);"), {"port-differs"}},
    });
}

TEST(WeighedEdit, WordForWordAtTheSamePlaces) {
    const BySide<std::string> before = {
        "void f(float* y, const float* x, float a, float d, int n) {\n"
        "  const int i = first_index();\n  if (i < n) { y[i] = a / d * x[i]; }\n  keep(y, a / d);\n}\n",
        "void f(int n, span x, span y, float a, float d) {\n  axpy(n, a / d, x.data(), y.data());\n"
        "  y.settle();\n  keep(y.data(), a / d);\n}\n"};
    const auto edited = [&](const std::string& in_source, const std::string& in_target) {
        return BySide<std::string>{replaced(before.source, "a / d * x[i]", in_source),
                                   replaced(before.target, "n, a / d", in_target)};
    };
    const std::string here = "a / (d + 0.5f) * x[i]";
    expect_all({
        {"one edit in statements that are not alike", before, edited(here, "n, a / (d + 0.5f)"), {}},
        {"another number", before, edited(here, "n, a / (d + 0.25f)"), {"port-differs"}},
        {"another sign", before, edited(here, "n, a / (d - 0.5f)"), {"port-differs"}},
        {"another variable", before, edited("a / (d + n) * x[i]", "n, a / (d + a)"), {"port-differs"}},
        {"another place of the statement", before, edited(here, "n, (a + 0.5f) / d"), {"port-differs"}},
        {"other brackets", before, edited(here, "n, (a / d + 0.5f)"), {"port-differs"}},
        {"another statement",
         before,
         {replaced(before.source, "a / d * x[i]", here), replaced(before.target, "(), a / d", "(), a / (d + 0.5f)")},
         {"port-differs"}},
        {"more on one side",
         before,
         {replaced(before.source, "a / d * x[i]", here),
          replaced(edited(here, "n, a / (d + 0.5f)").target, "y.settle();", "")},
         {"port-differs"}},
        {"another qualifier", before, edited("a / (d + 1) * x[i]", "n, a / (d + 1ull)"), {"port-differs"}},
    });
}

TEST(WeighedEdit, WordsBehindAnotherBracketStandAtAnotherPlace) {
    const auto sides = [](const std::string& in_source, const std::string& in_target, const std::string& more = "",
                          const std::string& more_there = "") {
        return BySide<std::string>{
            "void f(float* out, const float* x, const float* y, float s, float a, float d, float k, int i" + more +
                ") {\n  float b = s - d;\n  " + in_source + "\n  keep(out, b);\n}\n",
            "void f(span out, span x, span y, float s, float a, float d, float k, int n" + more_there + ") {\n  " +
                in_target + "\n  out.settle();\n  keep(out, s - d);\n}\n"};
    };
    const BySide<std::string> sum = sides("out[i] = s * (a + d);", "scale(out, n, a + d);"),
                              root = sides("out[i] = sqrt(x[i]) - y[i];", "sub(sqrt(x[i]), y[i], out);"),
                              part = sides("out[i] = a / d * x[i];", "axpy(n, a / d, x, out);");
    expect_all({
        {"inside", sum, sides("out[i] = s * (a + d * k);", "scale(out, n, a + d * k);"), {}},
        {"behind and inside", sum, sides("out[i] = s * (a + d) * k;", "scale(out, n, a + d * k);"), {"port-differs"}},
        {"the root and its argument",
         root,
         sides("out[i] = sqrt(x[i]) * k - y[i];", "sub(sqrt(x[i] * k), y[i], out);"),
         {"port-differs"}},
        {"a value and its index",
         root,
         sides("out[i] = sqrt(x[i]) - y[i] * k;", "sub(sqrt(x[i]), y[i * k], out);"),
         {"port-differs"}},
        {"a parameter of one type",
         part,
         sides("out[i] = a / (d + m) * x[i];", "axpy(n, a / (d + m), x, out);", ", float m", ", float m"),
         {}},
        {"of another type",
         part,
         sides("out[i] = a / (d + m) * x[i];", "axpy(n, a / (d + m), x, out);", ", float m", ", int m"),
         {"port-differs"}},
        {"in another order",
         part,
         sides("out[i] = a / (d + m - l) * x[i];", "axpy(n, a / (d + m - l), x, out);", ", float m, float l",
               ", float l, float m"),
         {"port-differs"}},
    });
}

TEST(WeighedEdit, WhatStandsBesideABlockIsNotWhatStandsInIt) {
    const auto text = [](const std::string& loop, const std::string& branch, const std::string& half,
                         const std::string& before, const std::string& in_loop, const std::string& in_branch,
                         const std::string& behind) {
        return "float f(const float* w, int n, float bias, float eps) {\n  float sum = 0.0f;\n" + before + loop +
               " {\n" + in_loop + "    sum += w[j];\n  }\n" + branch + " {\n" + in_branch + "    sum = eps;\n  }\n" +
               half + behind + "  return sum;\n}\n";
    };
    const auto source = [&](const auto&... edits) {
        return text("  for (int j = 0; j < n; ++j)", "  if (sum < eps)", "  sum = sum * 0.5f;\n", edits...);
    };
    const auto port = [&](const auto&... edits) {
        return text("  for (int j = 0; j != n; ++j)", "  if (eps >= sum)", "  sum *= 0.5f;\n", edits...);
    };
    const std::string none, gain = "    sum = sum - bias;\n";
    const BySide<std::string> before = {source(none, none, none, none), port(none, none, none, none)};
    const std::vector<std::string> found = {"port-differs"};
    expect_all({
        {"before the loop", before, {source(gain, none, none, none), port(gain, none, none, none)}, {}},
        {"in the loop", before, {source(none, gain, none, none), port(none, gain, none, none)}, {}},
        {"in the branch", before, {source(none, none, gain, none), port(none, none, gain, none)}, {}},
        {"behind the half", before, {source(none, none, none, gain), port(none, none, none, gain)}, {}},
        {"before, in", before, {source(gain, none, none, none), port(none, gain, none, none)}, found},
        {"in, before", before, {source(none, gain, none, none), port(gain, none, none, none)}, found},
        {"in the loop, in the branch", before, {source(none, gain, none, none), port(none, none, gain, none)}, found},
        {"behind the half, in the branch",
         before,
         {source(none, none, none, gain), port(none, none, gain, none)},
         found},
    });
}

TEST(WeighedEdit, ATruthAndANumberThatIsNotZero) {
    const std::string from = "y[out] = x[at];", there = "y.store(out, x.load(at));";
    expect_all({
        {"not zero",
         kCopy,
         copy_with(from, "if (is_wide) { y[out] = x[at] * lim + shift(at); }", there,
                   "if (is_wide != 0) { y.store(out, x.load(at) * lim + shift(at)); }"),
         {}},
        {"zero",
         kCopy,
         copy_with(from, "if (is_wide) { y[out] = x[at] * lim + shift(at); }", there,
                   "if (is_wide == 0) { y.store(out, x.load(at) * lim + shift(at)); }"),
         {"port-differs"}},
    });
}

TEST(WeighedEdit, OneSideComesNearerInItsOwnWords) {
    const BySide<std::string> apart = {
        "void f(float* y, const float* x, float lim, int n) {\n  y[0] = x[0];\n}\n",
        "void f(span y, span x, float lim, int n) {\n"
        "  if (lim > 0) { const float d = damp(x.load(0), lim, 0.5f); y.store(0, d); }\n}\n"};
    const auto source = [&](const std::string& body) {
        return BySide<std::string>{replaced(apart.source, "y[0] = x[0];", body), apart.target};
    };
    expect_all({
        {"what the port has", apart, source("if (lim > 0) { const float c = damp(x[0], lim, 0.5f); y[0] = c; }"), {}},
        {"another number",
         apart,
         source("if (lim > 0) { const float c = damp(x[0], lim, 0.7f); y[0] = c; }"),
         {"source-changed"}},
        {"more than the port has",
         apart,
         source("if (lim > 0) { const float c = damp(x[0], lim, 0.5f); y[0] = c + lim; }"),
         {"source-changed"}},
    });
}

TEST(WeighedEdit, AnotherSpellingOfACall) {
    const BySide<std::string> same = {"void f(float* p, float d) { keep_max(p, SQRT(d)); }",
                                      "void f(float* p, float d) { keep_max(p, SQRT(d)); }"};
    const auto target = [&](const std::string& text) { return BySide<std::string>{same.source, text}; };
    expect_all({
        {"case, underscores and std", same, target("void f(float* p, float d) { keepMax(p, std::sqrt(d)); }"), {}},
        {"another function",
         same,
         target("void f(float* p, float d) { keepMin(p, std::sqrt(d)); }"),
         {"target-changed"}},
        {"another function that looks alike, of the file itself",
         same,
         target("void f(float* p, float d) { keepMax(p, SQRT(d)); } void keepMax(float* p, float d) { *p = d; }"),
         {"target-changed"}},
        {"its own function no longer",
         {same.source, same.target + " void keep_max(float* p, float d) { *p = d; }"},
         target("void f(float* p, float d) { keepMax(p, SQRT(d)); } void keep_max(float* p, float d) { *p = d; }"),
         {"target-changed"}},
        {"less exact",
         {"void f(float* p, float d) { p[0] = expf(d); }", "void f(float* p, float d) { p[0] = expf(d); }"},
         {"void f(float* p, float d) { p[0] = __expf(d); }", "void f(float* p, float d) { p[0] = expf(d); }"},
         {"source-changed"}},
        {"another variable",
         {"void f(int n, int N) { g(n); }", "void f(int n, int N) { g(n); }"},
         {"void f(int n, int N) { g(n); }", "void f(int n, int N) { g(N); }"},
         {"target-changed"}},
    });
}

TEST(WeighedEdit, TheSameThingsGetTheSameType) {
    const BySide<std::string> was = {
        "__global__ void f(float* y, const float* x, int n) {\n  int i = blockIdx.x * blockDim.x + threadIdx.x;\n"
        "  if (i >= n) return;\n  y[i] = x[i] * 0.5f;\n}\n",
        "void f(span y, span x, int n) {\n  for (int i = 0; i < n; ++i) { y.store(i, x.load(i) * 0.5f); }\n}\n"};
    const auto row = [&](const std::string& what, const std::string& source, const std::string& target,
                         const Rules& rules) {
        const std::string index = "int i = blockIdx.x";
        return Weighed{
            what,
            was,
            {replaced(replaced(was.source, index, source + " i = (" + source + ") blockIdx.x"), "int n", source + " n"),
             replaced(replaced(was.target, "int i =", target + " i ="), "int n", target + " n")},
            rules};
    };
    const Rules told = {"port-differs"};
    Weighed other = row("and more", "size_t", "size_t", told);
    other.now.target = replaced(other.now.target, "0.5f", "0.25f");
    Weighed lone = row("one of them", "size_t", "size_t", told);
    lone.now.target = replaced(was.target, "int n", "size_t n");
    const Weighed bound{"another thing",
                        was,
                        {replaced(was.source, "int n", "size_t n"), replaced(was.target, "int i =", "size_t i =")},
                        told};
    Weighed cut_off = row("a cast to a type that nothing got", "size_t", "size_t", told);
    cut_off.now.target = replaced(cut_off.now.target, "x.load(i)", "(int) x.load(i)");
    expect_all({row("both", "size_t", "size_t", {}), row("another one", "size_t", "short", told), other, lone, bound,
                cut_off});
}

TEST(WeighedEdit, BranchesForTheCompilerThatOneSideHas) {
    const BySide<std::string> was = {
        "float f(__global const Leaf* leaf, float3 p, float3 n, float most, float lim) {\n"
        "  float best = most;\n  if ((apart(p, leaf->p) < best) && (dot(n, vload(leaf->n)) > lim)) {\n"
        "    best = apart(p, leaf->p);\n  }\n  return best * lim;\n}\n",
        "float f(const Leaf& leaf, const Point& p, const Normal& n, float most, float lim) {\n"
        "  float best = most;\n  if ((Apart(p, leaf.p) < best) && (Dot(n, leaf.n) > lim)) {\n"
        "    best = Apart(p, leaf.p);\n  }\n  return best * lim;\n}\n"};
    const auto with = [&](const std::string& source, const std::string& target) {
        return BySide<std::string>{
            replaced(replaced(was.source, "&& (dot(n, vload(leaf->n)) > lim)", source), "float lim)",
                     "float lim\n#if defined(HAS_FOG)\n, int is_fog, float thin\n#endif\n)"),
            replaced(replaced(was.target, "&& (Dot(n, leaf.n) > lim)", target), "float lim)",
                     "float lim, int is_fog, float thin)")};
    };
    const auto fog = [](const std::string& first, const std::string& last) {
        return "&&\n#" + first + "\n (leaf->is_fog == is_fog) && (leaf->thin < thin) && (is_fog ||\n#endif\n" +
               "(dot(n, vload(leaf->n)) > lim)\n#" + first + "\n" + last + "\n#endif\n";
    };
    const std::string there = "&& (leaf.is_fog == is_fog) && (leaf.thin < thin) && (is_fog || (Dot(n, leaf.n) > lim))";
    const Rules told = {"port-differs"};
    expect_all({
        {"under a switch", was, with(fog("if defined(HAS_FOG)", ")"), there), {}},
        {"under another sign", was,
         with(fog("if defined(HAS_FOG)", ")"), replaced(there, "thin < thin", "thin > thin")), told},
        {"where it is off", was, with(fog("ifndef HAS_FOG", ")"), there), told},
        {"under another switch than what it uses", was, with(fog("if defined(HAS_SUN)", ")"), there), told},
    });
    const auto mist = [&](const std::string& name) {
        return BySide<std::string>{
            replaced(was.source, "return best * lim;",
                     "\n#ifdef " + name +
                         "\nbest = thin_out(best, lim, n);\n#endif\n"
                         "return best * lim;"),
            replaced(was.target, "return best * lim;", "best = ThinOut(best, lim, n); return best * lim;")};
    };
    const std::string other = "float g(float a) {\n#ifdef HAS_FOG\n  a += 1.0f;\n#endif\n  return a;\n}\n";
    BySide<std::string> was_with = was, now_with = mist("HAS_FOG"), now_other = mist("HAS_FROG");
    for (BySide<std::string>* texts : {&was_with, &now_with, &now_other}) texts->source += other;
    expect_all({{"a switch that another function asks for", was_with, now_with, {}},
                {"one that nothing else asks for", was_with, now_other, told}});
}

TEST(WeighedEdit, TheSameNamesInTheWaysOfTwoRuntimes) {
    const BySide<std::string> was = {
        "void f(float* out, const float* in, const float* old, int n, int rows) {\n  float *d_in, *d_out, *d_old;\n"
        "  cudaMalloc(&d_in, n * 4);\n  shade_1<<<n / 64, 64>>>(d_in, d_out, n);\n  cudaDeviceSynchronize();\n}\n",
        "void f(float* out, const float* in, const float* old, int n, int rows) {\n  sycl::queue q;\n"
        "  float* d_in = sycl::malloc_device<float>(n, q);\n"
        "  q.parallel_for(sycl::nd_range<1>(n / 64 * 64, 64), [=](sycl::nd_item<1> item) { shade_1(item, d_in, d_out, "
        "n); "
        "});\n  q.wait();\n}\n"};
    const auto row = [&](const std::string& what, const std::string& source, const std::string& target,
                         const Rules& rules) {
        return Weighed{
            what,
            was,
            {replaced(was.source, "  cudaDeviceSynchronize();\n}", "  cudaDeviceSynchronize();\n" + source + "}"),
             replaced(was.target, "  q.wait();\n}", "  q.wait();\n" + target + "}")},
            rules};
    };
    const std::string here =
                          "  cudaMemset(d_out, 0, n * rows);\n  shade_2<<<n / 32, 32>>>(d_out, d_old, rows);\n"
                          "  cudaDeviceSynchronize();\n",
                      there =
                          "  q.memset(d_out, 0, n * rows);\n  q.parallel_for(sycl::nd_range<1>(n / 32 * 32, 32), "
                          "[=](sycl::nd_item<1> item) { shade_2(item, d_out, d_old, rows); });\n  q.wait();\n";
    const Rules told = {"port-differs"};
    expect_all({row("a launch", here, there, {}),
                row("arguments exchanged", here, replaced(there, "d_out, d_old", "d_old, d_out"), told),
                row("another argument", here, replaced(there, "d_old, rows", "d_in, rows"), told),
                row("one more", here, replaced(there, "d_old, rows", "d_old, n, rows"), told),
                row("another number", here, replaced(there, ", 32)", ", 16)"), told),
                row("another function", here, replaced(there, "shade_2", "shade_1"), told)});
}

TEST(WeighedEdit, HowManyThreadsALaunchIsGivenWhereBothRuntimesLaunchAlike) {
    const BySide<std::string> was = {
        "void f(float* d_in, float* d_out, int grid, int lanes) {\n  cudaMemset(d_out, 0, grid);\n"
        "  shade_1<<<grid, lanes>>>(d_in, d_out);\n}\n",
        "void f(float* d_in, float* d_out, int grid, int lanes) {\n  hipMemset(d_out, 0, grid);\n"
        "  shade_1<<<grid, lanes>>>(d_in, d_out);\n}\n"};
    const auto with = [](const std::string& text, const std::string& more) {
        return replaced(text, "(d_in, d_out);\n}", "(d_in, d_out);\n" + more + "}");
    };
    const std::string here =
                          "  cudaMemcpyAsync(d_in, d_out, 4 * rows, cudaMemcpyDeviceToDevice);\n"
                          "  shade_2<<<grid, lanes>>>(as_wide(d_in), d_out);\n"
                          "  shade_3<<<grid, lanes>>>(as_wide(d_in), d_out);\n",
                      there =
                          "  hipMemcpyDtoDAsync(d_in, d_out, 4 * rows);\n"
                          "  shade_2<<<grid, lanes>>>(as_wide(d_in), d_out);\n"
                          "  shade_3<<<grid, lanes>>>(as_wide(d_in), d_out);\n";
    const auto row = [&](const std::string& what, const std::string& port, const Rules& rules) {
        return Weighed{what, was, {with(was.source, here), with(was.target, port)}, rules};
    };
    const Rules told = {"port-differs"};
    expect_all({row("the same", there, {}),
                row("the first number twice", replaced(there, "shade_2<<<grid, lanes", "shade_2<<<grid, grid"), told),
                row("the second twice", replaced(there, "shade_3<<<grid, lanes", "shade_3<<<lanes, lanes"), told),
                row("exchanged", replaced(there, "shade_3<<<grid, lanes", "shade_3<<<lanes, grid"), told)});
}

TEST(WeighedEdit, WhatIsPrintedOrTimed) {
    const BySide<std::string> same = {"void f(float* p, float d) { p[0] = d * 2; p[1] = d; }",
                                      "void f(float* p, float d) { p[0] = d * 2; p[1] = d; }"};
    const auto source = [&](const std::string& text) { return BySide<std::string>{text, same.target}; };
    expect_all({
        {"it prints",
         same,
         source("void f(float* p, float d) { p[0] = d * 2; printf(\"%f\\n\", p[0]); assert(d > 0); p[1] = d; }"),
         {}},
        {"it takes the time",
         same,
         source("void f(float* p, float d) {\n#ifdef TIMING\nt0 = now();\n#endif\np[0] = d * 2; p[1] = d; }"),
         {}},
        {"it does more",
         same,
         source("void f(float* p, float d) { p[0] = d * 2; printf(\"%f\\n\", p[0]); p[1] = -d; }"),
         {"source-changed"}},
    });
    // What speaks, or reads a clock, and does something else as well.
    for (const std::string body : {"printf(\"%f\", d *= 2 + lim);",
                                   "assert(d = 2 + lim * 3);",
                                   "assert(d++ < 3 + lim);",
                                   "cout << (d = 2 + lim * 3);",
                                   "warn(d, 2, 3, 4), d = 3;",
                                   "printf(\"x\"), g(d), h(d);",
                                   "assert(d > 0 || (exit(3), 1));",
                                   "logistic(d, &d, 2, 3);",
                                   "fingerprint(&d, 2, 3, 4);",
                                   "print(&d, 2, 3, 4, 5);",
                                   "assert(initialize(p, lim) == 0);",
                                   "printf(\"%f\\n\", next_sample(state, lim));",
                                   "assert(queue.push(d + lim));",
                                   "d = d * profile_scale + 2;",
                                   "d -= elapsed * lim * 2;",
                                   "p[1] = elapsed(d) * 3 + 1;",
                                   "float& elapsed = d; elapsed = 2 + lim;",
                                   "float* profile = p; profile[0] = 2;",
                                   "advance(elapsed, d, 2, 3);",
                                   "\n#ifdef DEBUG_ALWAYS\nd = 2 + lim * 3;\n#endif\n",
                                   "\n#ifdef TIMING\nif (d > 1) return;\n#endif\n",
                                   "\n#ifdef BENCH\nadvance(&d, 2, 3, 4);\n#endif\n"})
        expect_all({{body,
                     same,
                     source("void f(float* p, float d) { p[0] = d * 2; " + body + " p[1] = d; }"),
                     {"source-changed"}}});
    for (const std::string body :
         {"std::cout << d << lim << \"x\" << std::endl;", "log_error(\"%f\", d + lim * 2);",
          "assert(is_even(count_of(p)) && p.size() > 2);", "fprintf(stderr, \"%f %f\", d, lim);",
          "gettimeofday(&tv, 0); double elapsed = tv.tv_sec * 1e6;",
          "auto t0 = std::chrono::steady_clock::now(); elapsed += t0 - start;",
          "\n#ifdef DEBUG\nint hits = count(p); hits += 3; report(hits);\n#endif\n"})
        expect_all({{body, same, source("void f(float* p, float d) { p[0] = d * 2; " + body + " p[1] = d; }"), {}}});
    const BySide<std::string> prints = {"void f(int d) { g(d); printf(\"%d\", d + 1); }",
                                        "void f(int d) { g(d); printf(\"%d\", d + 1); }"};
    expect_all({{"a word of what is printed is no note",
                 prints,
                 {"void f(int d) { g(d); printf(\"%d\", d + 2); }", prints.target},
                 {"source-changed"}}});
}

Words words_of(const std::string& text) {
    Words out;
    for (size_t i = 0; i < text.size();) {
        const size_t end = std::min(text.find(' ', i), text.size());
        out.push_back(std::string_view(text).substr(i, end - i));
        i = end + 1;
    }
    return out;
}

TEST(WeighedEdit, ArmsOfASwitchHaveNoOrder) {
    const auto sorted = [](const std::string& text) {
        std::string out;
        for (const std::string_view word : with_sorted_cases(words_of(text))) out += std::string(word) + " ";
        return out;
    };
    const std::string one = "switch ( k ) { case B : case A : return f ( k ) ; case C : g ( ) ; break ; }";
    const std::string other = "switch ( k ) { case C : { g ( ) ; break ; } case A : case B : return f ( k ) ; }";
    EXPECT_EQ(sorted(one), sorted(other));
    const std::string falls = "switch ( k ) { case B : f ( ) ; case A : g ( ) ; break ; }";
    const std::string turned = "switch ( k ) { case A : g ( ) ; case B : f ( ) ; break ; }";
    EXPECT_NE(sorted(falls), sorted(turned));
    const std::string passed = "switch ( k ) { case B : if ( x ) { return 1 ; } case A : g ( ) ; }";
    const std::string passed_too = "switch ( k ) { case A : g ( ) ; case B : if ( x ) { return 1 ; } }";
    EXPECT_NE(sorted(passed), sorted(passed_too));
    const std::string guarded = "switch ( k ) { case B : # ifdef X return 1 ; # endif case A : return 2 ; }";
    EXPECT_EQ(sorted(guarded), guarded + " ");
}

TEST(WeighedEdit, NamesOfBothSidesAreLike) {
    EXPECT_TRUE(are_like("gpu_op_add", "cpuOpAdd"));
    EXPECT_TRUE(are_like("PREVIOUS_FLOAT", "previousFloat"));
    EXPECT_FALSE(are_like("gpu_op_add", "gpu_pool_free"));
    EXPECT_FALSE(are_like("min", "max"));
}

/// A source that is rewritten in the port's manner: `part` of its text becomes what the rows say.
struct Rewriting {
    BySide<std::string> texts;
    std::string part;
    std::vector<std::string> right, wrong;
};

void expect_told_apart(const Rewriting& one) {
    const auto rules = [&](const std::string& to) {
        return open_rules({to, one.texts, {replaced(one.texts.source, one.part, to), one.texts.target}, {}});
    };
    for (const std::string& to : one.right) EXPECT_EQ(rules(to), Rules{}) << to;
    for (const std::string& to : one.wrong) EXPECT_EQ(rules(to), Rules{"source-changed"}) << to;
}

TEST(WeighedEdit, TheOthersWordsInAnotherOrder) {
    const std::string limits = "  if (rho < lo) rho = lo;\n  if (rho > hi) rho = hi;\n  return rho;\n",
                      clamped = "{ return std::min(std::max(rho, lo), hi); }\n";
    const std::vector<std::string> right = {"return fminf(fmaxf(rho, lo), hi);"},
                                   wrong = {"return fminf(fmaxf(rho, hi), lo);", "return fminf(fmaxf(lo, rho), hi);",
                                            "return fmaxf(fminf(rho, lo), hi);", "return fminf(fmaxf(lo, hi), rho);",
                                            "return fminf(fmaxf(rho, lo), lo);"};
    const std::string head = "float f(float rho, float lo, float hi) ",
                      other_names = replaced(replaced(replaced(head + clamped, "rho, lo), hi", "value, least), most"),
                                                      "float rho, float lo", "float value, float least"),
                                             "float hi", "float most");
    expect_told_apart({{"__device__ " + head + "{\n" + limits + "}\n", head + clamped}, limits, right, wrong});
    expect_told_apart({{"__device__ " + head + "{\n" + limits + "}\n", other_names}, limits, right, wrong});

    const std::string polar =
                          "(unsigned i, unsigned n) {\n  float phi = 2.399963f * i;\n"
                          "  float c = 1.0f - (i + 0.5f) / n;\n  float s = sqrt(1.0f - c * c);\n",
                      parts = "  float3 r;\n  r.x = cosf(phi) * s;\n  r.y = sinf(phi) * s;\n  r.z = c;\n  return r;\n";
    expect_told_apart({{"float3 f" + polar + parts + "}\n",
                        "vec3 f" + polar + "  return vec3(std::cos(phi) * s, std::sin(phi) * s, c);\n}\n"},
                       parts,
                       {"return make_float3(cosf(phi) * s, sinf(phi) * s, c);"},
                       {"return make_float3(c, sinf(phi) * s, cosf(phi) * s);",
                        "return make_float3(sinf(phi) * s, cosf(phi) * s, c);",
                        "return make_float3(cosf(phi) * s, cosf(phi) * s, c);",
                        "return make_float3(cosf(phi) * c, sinf(phi) * c, s);",
                        "return make_float3(cosf(s) * phi, sinf(phi) * s, c);",
                        "return make_float3(cosf(phi) * s, sinf(phi) * s, s);"}});

    const std::string taps =
                          "float f(const float2* uv, float4 k, int n) {\n  float acc = 0.0f;\n"
                          "  for (int tap = 0; tap < n; tap++) {\n    float2 p = uv[tap];\n",
                      sums = "    acc = acc + k.x;\n    acc = acc + p.y;\n",
                      weighed = "    const float d = (p.x - k.x) / k.w;\n    if (d < p.y) acc += d * k.y;\n",
                      end = "  }\n  return acc;\n}\n";
    Rewriting sum{{taps + sums + end, taps + weighed + end}, sums, {weighed}, {}};
    const std::vector<std::pair<std::string, std::string>> slips = {
        {"p.x - k.x", "k.x - p.x"}, {"/ k.w", "/ k.y"},       {"d < p.y", "p.y < d"},     {"p.x - k.x", "p.y - k.x"},
        {"d < p.y", "d < p.x"},     {"d * k.y", "p.y * k.y"}, {"acc += d", "acc += tap"}, {"d < p.y", "d < k.y"}};
    for (const auto& [from, to] : slips) sum.wrong.push_back(replaced(weighed, from, to));
    expect_told_apart(sum);
}

}  // namespace
}  // namespace porttool::testing::weighed_edit_test

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Edits of both sides that are one in other words, each beside edits like it that are not: the first raise nothing, or
// a note where only the last bit may differ, the second stay errors or warnings.
#include <gtest/gtest.h>

#include "porttool/scan/side.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::kinds_and_spellings_test {
namespace {

/// A pair of functions `f` before and after the edits.
struct EditedPair {
    BySide<std::string> paths, before, now;
};

/// The level of the loudest finding; "" if there is none.
std::string loudest(const EditedPair& pair) {
    MemoryDisk disk;
    const BySide<std::string> files = {"/r/s/" + pair.paths.source, "/r/t/" + pair.paths.target};
    for (const Side side : kBothSides) disk.files[files[side]] = pair.before[side];
    disk.files["/r/portmap.toml"] =
        "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n[[pair]]\nsource = \"s/" + pair.paths.source +
        ":f\"\ntarget = \"t/" + pair.paths.target + ":f\"\n";
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
    for (const Side side : kBothSides) disk.files[files[side]] = pair.now[side];
    std::string out;
    const auto report = check(disk);
    for (const auto& finding : report["findings"]) {
        const std::string level = finding["level"];
        if (out.empty() || level == "error" || (level == "warning" && out == "note")) out = level;
    }
    return out;
}

enum class Said : uint8_t { Nothing, NoteAtMost, Told };

void expect_said(const std::string& level, Said said, const std::string& what) {
    const bool is_quiet = level.empty(), is_note = level == "note";
    EXPECT_TRUE(said == Said::Told ? !is_quiet && !is_note : is_quiet || (is_note && said == Said::NoteAtMost))
        << what << ": " << level;
}

struct Manner {
    BySide<std::string> paths;
    std::string head_of_source, real_mark;
};

const Manner kGlsl = {{"k.glsl", "k.cpp"}, "float", ""};
const Manner kCuda = {{"k.cu", "k.cpp"}, "__device__ float", "f"};
const Manner kOpenCl = {{"k.cl", "k.c"}, "float", "f"};

/// `1.5#` as the side writes it.
std::string marked(std::string text, const std::string& mark) {
    for (size_t at = text.find('#'); at != std::string::npos; at = text.find('#', at)) text.replace(at, 1, mark);
    return text;
}

/// A function with numbers of all kinds, into which both sides put a statement.
EditedPair numbers(const Manner& manner, const std::string& source, const std::string& target) {
    const auto text = [](const std::string& head, const std::string& more) {
        return head +
               " f(uint m, int k, int n, float gain, float bias) {\n  float total = 0.0f;\n  float norm = 1.0f;\n"
               "  for (int j = 0; j < n; ++j) {\n    total += gain;\n    norm *= bias;\n  }\n  " +
               more + "\n  total = total * 0.5f + norm;\n  return total + norm * bias;\n}\n";
    };
    const auto here = [&](const std::string& more) {
        std::string out = text(manner.head_of_source, marked(more, manner.real_mark));
        if (manner.real_mark.empty())
            out = replaced(replaced(replaced(out, "0.0f", "0.0"), "1.0f", "1.0"), "0.5f", "0.5");
        return out;
    };
    const auto there = [&](const std::string& more) { return text("float", marked(more, "f")); };
    return {manner.paths, {here(""), there("")}, {here(source), there(target)}};
}

struct Gained {
    std::string source, target;
    Said said;
};

void expect_all(const std::vector<Manner>& manners, const std::vector<Gained>& rows) {
    for (const Manner& manner : manners)
        for (const Gained& row : rows)
            expect_said(loudest(numbers(manner, row.source, row.target)), row.said,
                        manner.paths.source + ": " + row.source + " | " + row.target);
}

TEST(KindsAndSpellings, AMarkThatTakesTheSignAway) {
    expect_all({kGlsl, kCuda, kOpenCl},
               {{"total += k / 2;", "total += k / 2;", Said::Nothing},
                {"total += k / 2;", "total += k / 2u;", Said::Told},
                {"int q = k % 3; total += q;", "int q = k % 3u; total += q;", Said::Told},
                {"if (k - 4 < 1) { total = norm; }", "if (k - 4 < 1u) { total = norm; }", Said::Told},
                {"total -= (k - 9) / 3;", "total -= (k - 9) / 3u;", Said::Told},
                {"total += k * 2;", "total += k * 2u;", Said::Told},
                {"total = float(-1 < k);", "total = float(-1 < k);", Said::Nothing},
                {"total += m / 2u;", "total += m / 2u;", Said::Nothing},
                {"total += m / 2u;", "total += m / 2;", Said::Nothing},              // of a number without a sign
                {"total += m & 255u;", "total += m & 255;", Said::Nothing},          // no bit of it is the sign
                {"total += thing.k / 2u;", "total += thing.k / 2;", Said::Nothing},  // nobody knows
                {"int q = k + 1; total += q;", "int q = k + 1u; total += q;", Said::Nothing}});
}

TEST(KindsAndSpellings, AbsOfCIsOneOfWholeNumbers) {
    expect_all({kGlsl},
               {{"total = abs(total - gain) * 2.0#;", "total = std::abs(total - gain) * 2.0#;", Said::Nothing}});
    const Manner in_c = {{"k.glsl", "k.c"}, "float", ""};
    expect_all({in_c}, {{"total = abs(total - gain) * 2.0#;", "total = fabsf(total - gain) * 2.0#;", Said::Nothing},
                        {"total = abs(total - gain) * 2.0#;", "total = abs(total - gain) * 2.0#;", Said::Told},
                        {"total += abs(k - 4);", "total += abs(k - 4);", Said::Nothing}});
    expect_all({kOpenCl}, {{"total = fabs(total) + bias;", "total = abs(total) + bias;", Said::Told},
                           {"total = fabs(total) + bias;", "total = fabsf(total) + bias;", Said::Nothing}});
}

TEST(KindsAndSpellings, StepsCountersAndUpdates) {
    const auto loop = [](const std::string& head, const std::string& body) {
        return "for (" + head + ") { " + body + " }";
    };
    const std::string body = "total += w[q];";
    expect_all({kGlsl, kCuda, kOpenCl},
               {{loop("int q = 0; q < n; q++", body), loop("int q = 0; q < n; ++q", body), Said::Nothing},
                {loop("int q = 0; q < n; q++", body), loop("int q = 0; q < n; --q", body), Said::Told},
                {loop("int q = 0; q < n; ++q", body), loop("uint q = 0; q < n; ++q", body), Said::Nothing},
                {loop("int q = 1; q < n; ++q", "total += w[q - 1];"),
                 loop("uint q = 1; q < n; ++q", "total += w[q - 1];"), Said::Told},
                {loop("int q = 0; q < n; ++q", "total += q * k;"), loop("uint q = 0; q < n; ++q", "total += q * k;"),
                 Said::Told},
                {loop("int q = n - 1; q >= 0; --q", body), loop("uint q = n - 1; q >= 0; --q", body), Said::Told},
                {loop("int q = 0; q < n; ++q", body), loop("uint q = 0; q <= n; ++q", body), Said::Told},
                {loop("int q = 0; q < n; ++q", body), loop("short q = 0; q < n; ++q", body), Said::Told},
                {"total += norm * bias;", "total = total + norm * bias;", Said::Nothing},
                {"total += norm * bias;", "total = total - norm * bias;", Said::Told},
                {"total += norm * bias;", "total = norm + norm * bias;", Said::Told},
                {"total -= norm - bias;", "total = total - norm - bias;", Said::Told},
                {"total *= norm + bias;", "total = total * norm + bias;", Said::Told},
                {"total *= norm + bias;", "total = total * (norm + bias);", Said::NoteAtMost}});
}

TEST(KindsAndSpellings, Limits) {
    expect_all({kGlsl, kCuda, kOpenCl},
               {{"total = clamp(total, 0.0#, gain);", "total = fminf(fmaxf(total, 0.0#), gain);", Said::NoteAtMost},
                {"total = clamp(total, 0.0#, gain);", "total = fminf(fmaxf(total, 0.0#), bias);", Said::Told},
                {"total = clamp(total, 0.0#, gain);", "total = fminf(fmaxf(total, 1.0#), gain);", Said::Told},
                {"total = clamp(total, bias, gain);", "total = fminf(fmaxf(total, gain), bias);", Said::Told},
                {"total = clamp(total, bias, gain);", "total = fmaxf(fminf(total, bias), gain);", Said::Told},
                {"total = clamp(total, 0.0#, gain);", "total = fminf(total, gain);", Said::Told}});
    const Manner hlsl = {{"k.hlsl", "k.cpp"}, "float", ""};
    expect_all({hlsl}, {{"total = saturate(total);", "total = std::clamp(total, 0.0f, 1.0f);", Said::NoteAtMost},
                        {"total = saturate(total);", "total = std::clamp(total, 0.0f, 2.0f);", Said::Told}});
}

TEST(KindsAndSpellings, WhatOnlyRoundsOtherwiseIsANote) {
    expect_all({kGlsl, kCuda, kOpenCl},
               {{"total = fma(total, gain, bias);", "total = total * gain + bias;", Said::NoteAtMost},
                {"total = fma(total, gain, bias);", "total = total * gain - bias;", Said::Told},
                {"total = fma(total, gain, bias);", "total = total * bias + gain;", Said::Told},
                {"total = fma(total, gain, -bias);", "total = total * gain - bias;", Said::NoteAtMost},
                {"total = fma(total, gain, -w[1]);", "total = total * gain - w[1];", Said::NoteAtMost},
                {"total = fma(total, gain, -bias);", "total = total * gain + bias;", Said::Told},
                {"total = fma(total, gain, -bias + norm);", "total = total * gain - (bias + norm);", Said::Told},
                {"total = fma(-total, gain, bias);", "total = total * gain - bias;", Said::Told},
                {"total *= rsqrt(norm);", "total *= 1.0# / sqrt(norm);", Said::NoteAtMost},
                {"total *= rsqrt(norm);", "total *= 2.0# / sqrt(norm);", Said::Told},
                {"total *= rsqrt(norm);", "total *= 1.0# / sqrt(bias);", Said::Told},
                {"total *= rsqrt(norm);", "total *= sqrt(norm);", Said::Told},
                {"total = pow(total, 2.0#) + bias;", "total = total * total + bias;", Said::NoteAtMost},
                {"total = pow(total, 3.0#) + bias;", "total = total * total + bias;", Said::Told}});
    expect_all({kCuda, kOpenCl},
               {{"float q = total * gain; norm += q;", "norm += total * gain;", Said::NoteAtMost},
                {"float q = total * gain; norm += q;", "norm += total * bias;", Said::Told},
                {"total = norm > 2.0# ? gain : total;", "if (norm > 2.0#) { total = gain; }", Said::NoteAtMost},
                {"total = norm > 2.0# ? gain : total;", "if (norm < 2.0#) { total = gain; }", Said::Told}});
}

/// A kernel with vectors, and a port that has each part by itself.
EditedPair vectors(const std::string& source, const std::array<std::string, 3>& parts, const std::string& in_source,
                   const std::string& in_target) {
    const auto port = [&](std::string text) {
        for (const std::string name : {"c", "q", "e"})
            for (size_t k = 0; k < parts.size(); ++k)
                for (const std::string part = name + "@" + std::to_string(k); text.find(part) != std::string::npos;)
                    text.replace(text.find(part), part.size(), name + parts.at(k));
        return text;
    };
    const auto here = [&](const std::string& more) {
        return source +
               " f(float3 q, float3 e, float a, float b) {\n  float3 c = q * a;\n  float total = c.x + c.y;\n  " +
               more + "\n  total += c.x * b + c.y + c.z;\n  return total;\n}\n";
    };
    const auto there = [&](const std::string& more) {
        return port(
            "float f(float q@0, float q@1, float q@2, float e@0, float e@1, float e@2, float a, float b) {\n"
            "  float c@0 = q@0 * a;\n  float c@1 = q@1 * a;\n  float c@2 = q@2 * a;\n"
            "  float total = c@0 + c@1;\n  " +
            more + "\n  total += c@0 * b + c@1 + c@2;\n  return total;\n}\n");
    };
    return {{"k.cu", "k.cpp"}, {here(""), there("")}, {here(in_source), there(in_target)}};
}

TEST(KindsAndSpellings, AVectorAgainstItsParts) {
    const std::vector<Gained> rows = {
        {"c += e * b;", "c@0 += e@0 * b; c@1 += e@1 * b; c@2 += e@2 * b;", Said::Nothing},
        {"c += e * b;", "c@0 += e@0 * b; c@1 += e@1 * b;", Said::Told},
        {"c += e * b;", "c@0 += e@0 * b; c@1 += e@1 * b; c@2 += e@1 * b;", Said::Told},
        {"c += e * b;", "c@0 += e@0 * b; c@1 -= e@1 * b; c@2 += e@2 * b;", Said::Told},
        {"c += e * b;", "c@0 += e@0 * a; c@1 += e@1 * a; c@2 += e@2 * a;", Said::Told},
        {"c += e * b;", "c@1 += e@0 * b; c@2 += e@1 * b; c@0 += e@2 * b;", Said::Told},
        {"c = c * 0.5f;", "c@0 *= 0.5f; c@1 *= 0.5f; c@2 *= 0.5f;", Said::Nothing},
        {"c = c * 0.5f;", "c@0 *= 0.5f; c@1 *= 0.25f; c@2 *= 0.5f;", Said::Told},
        {"c.y = c.y * b;", "c@1 = c@1 * b;", Said::Nothing},
        {"c.y = c.y * b;", "c@2 = c@2 * b;", Said::Told},
    };
    for (const auto& parts : {std::array<std::string, 3>{"x", "y", "z"}, std::array<std::string, 3>{"_r", "_g", "_b"},
                              std::array<std::string, 3>{"0", "1", "2"}})
        for (const Gained& row : rows)
            expect_said(loudest(vectors("__device__ float", parts, row.source, row.target)), row.said,
                        parts[1] + ": " + row.source + " | " + row.target);
}

TEST(KindsAndSpellings, AMemberThatThePortHasByItself) {
    const std::string source = "__device__ float f(Range q, float a) {\n  float s = q.lo * a;\n  float t = q.hi * a;\n",
                      target =
                          "float f(float q_lo, float q_hi, float a) {\n  float s = q_lo * a;\n  float t = q_hi * a;\n",
                      end = "  return s + t;\n}\n";
    const auto said = [&](const std::string& here, const std::string& there) {
        return loudest({{"k.cu", "k.cpp"}, {source + end, target + end}, {source + here + end, target + there + end}});
    };
    expect_said(said("  s += q.lo * 0.5f;\n", "  s += q_lo * 0.5f;\n"), Said::Nothing, "low");
    expect_said(said("  s += q.lo * 0.5f;\n", "  s += q_hi * 0.5f;\n"), Said::Told, "high for low");
    expect_said(said("  s += q.lo; t += q.hi;\n", "  s += q_lo; t += q_hi;\n"), Said::Nothing, "both");
    expect_said(said("  s += q.lo; t += q.hi;\n", "  s += q_lo;\n"), Said::Told, "one of both");
}

/// One side alone is edited.
std::string after_lone_edit(const std::string& before, const std::string& now, const std::string& type) {
    const auto text = [&](const std::string& body) {
        return type + " f(float x, int k, int n) {\n  float q = x;\n" + body + "\n  return q;\n}\n";
    };
    return loudest(
        {{"k.cu", "k.cpp"}, {"__device__ " + text(before), text(before)}, {"__device__ " + text(now), text(before)}});
}

TEST(KindsAndSpellings, AWholeNumberWhereARealOneIsAskedFor) {
    const std::vector<std::pair<std::string, std::string>> same = {
        {"q = 0;", "q = 0.0f;"},
        {"q = q * 2;", "q = q * 2.0f;"},
        {"if (q < 0) { q = x; }", "if (q < 0.0f) { q = x; }"},
        {"float p = 1; q += p * x;", "float p = 1.0f; q += p * x;"},
        {"if (n < 1) { return 0; }", "if (n < 1) { return 0.0f; }"},
        {"float a = x, b = q; q = a * b;", "float a = x; float b = q; q = a * b;"},
        {"\n#if defined(A) || defined(B)\nfloat a = x, b = q; q = a * b;\n#endif\n",
         "\n#if defined(A) || defined(B)\nfloat a = x; float b = q; q = a * b;\n#endif\n"},
    };
    for (const auto& [before, now] : same) EXPECT_EQ(after_lone_edit(before, now, "float"), "") << now;
    const std::vector<std::pair<std::string, std::string>> other = {
        {"q = 0;", "q = 1.0f;"},
        {"q = q * 2;", "q = q * 2.0;"},  // in twice as many bits
        {"q = k / 2;", "q = k / 2.0f;"},
        {"q = q * (2 / 3);", "q = q * (2.0f / 3);"},
        {"q = g(0);", "q = g(0.0f);"},
        {"int p = 1; q += p;", "int p = 1.5f; q += p;"},
        {"q = 16777217;", "q = 16777217.0f;"},
        {"q = 1.0f;", "q = 1.0;"},
        {"float a = x, b = q; q = a * b;", "float b = q; float a = x; q = a - b;"},
        {"\n#if defined(A) || defined(B)\nq = x;\n#endif\n", "\n#if defined(A) || defined(C)\nq = x;\n#endif\n"},
        {"\n#if defined(A) || defined(B)\nq = x;\n#endif\n", "\n#if defined(A) && defined(B)\nq = x;\n#endif\n"},
    };
    for (const auto& [before, now] : other) EXPECT_NE(after_lone_edit(before, now, "float"), "") << now;
}

TEST(KindsAndSpellings, MembersOfABlockOfHlsl) {
    const std::string block = "cbuffer P : register(b0) {\n  float lobe;\n  int taps[4];\n};\n",
                      kernel = "float f(float x) {\n  return x * taps[1];\n}\n",
                      port = "float f(float x) {\n  return x * params.taps[1];\n}\n";
    const auto said = [&](const std::string& from, const std::string& to) {
        return loudest({{"k.hlsl", "k.cpp"}, {block + kernel, port}, {replaced(block, from, to) + kernel, port}});
    };
    expect_said(said("int taps", "uint taps"), Said::Told, "its type");
    expect_said(said("taps[4]", "taps[8]"), Said::Told, "how many");
    expect_said(said("float lobe", "half lobe"), Said::Nothing, "another member");
    expect_said(said("};", "  float more;\n};"), Said::Nothing, "one more");
}

TEST(KindsAndSpellings, ANewWordIsTheSameNumberOnBothSides) {
    const std::string here = "__device__ float f(float x, int k) {\n", there = "float f(float x, int k) {\n",
                      end = "  return x;\n}\n", use = "  if (k == Fast) { x = x * 0.5f; }\n",
                      modes = "enum Mode { Exact, Fast };\n", others = "enum Mode { Fast, Exact };\n";
    const auto said = [&](const std::string& in_source, const std::string& in_target, const std::string& before) {
        return loudest({{"k.cu", "k.cpp"},
                        {before + here + end, before + there + end},
                        {in_source + here + use + end, in_target + there + use + end}});
    };
    expect_said(said(modes, modes, modes), Said::Nothing, "the same");
    expect_said(said(modes, others, modes), Said::Told, "in another order");
    expect_said(said(modes, replaced(modes, "Fast", "Fast = 3"), modes), Said::Told, "another number");
}

TEST(KindsAndSpellings, ChoicesAndLimitsInAnotherManner) {
    const auto pick = [](const std::string& condition, const std::string& yes, const std::string& no) {
        return "if (" + condition + ") { total = " + yes + "; } else { total = " + no + "; }";
    };
    expect_all({kGlsl, kCuda, kOpenCl},
               {{pick("k > n", "gain", "bias"), pick("k <= n", "bias", "gain"), Said::NoteAtMost},
                {pick("k > n", "gain", "bias"), pick("!(k > n)", "bias", "gain"), Said::NoteAtMost},
                {pick("k == n", "gain", "bias"), pick("n != k", "bias", "gain"), Said::NoteAtMost},
                {pick("k > n", "gain", "bias"), "total = n < k ? gain : bias;", Said::NoteAtMost},
                {pick("k > n", "gain", "bias"), pick("k <= n", "gain", "bias"), Said::Told},
                {pick("k > n", "gain", "bias"), pick("k < n", "bias", "gain"), Said::Told},
                {pick("k > n", "gain", "bias"), pick("k >= n", "gain", "bias"), Said::Told},
                {pick("k == n", "gain", "bias"), pick("k != n", "gain", "bias"), Said::Told},
                {pick("k > n && m > 1u", "gain", "bias"), pick("k <= n && m > 1u", "bias", "gain"), Said::Told},
                {"if (k > n) { total = gain; }", "if (n < k) { total = gain; }", Said::NoteAtMost},
                {"if (k > n) { total = gain; }", "if (n <= k) { total = gain; }", Said::Told},
                {"total = k > n ? gain : bias;", "total = k <= n ? bias : gain;", Said::NoteAtMost},
                {"total = k > n ? gain : bias;", "total = k <= n ? gain : bias;", Said::Told},
                {"total = max(gain, total);", "total = gain < total ? total : gain;", Said::NoteAtMost},
                {"total = max(gain, total);", "if (total < gain) { total = gain; }", Said::NoteAtMost},
                {"total = max(gain, total);", "total = gain < total ? gain : total;", Said::Told},
                {"total = max(gain, total);", "if (total > gain) { total = gain; }", Said::Told},
                {"total = max(gain, total);", "if (total < gain) { total = bias; }", Said::Told},
                {"total *= step(gain, norm);", "total *= norm < gain ? 0.0# : 1.0#;", Said::NoteAtMost},
                {"total *= step(gain, norm);", "total *= gain < norm ? 0.0# : 1.0#;", Said::Told},
                {"total *= step(gain, norm);", "total *= norm < gain ? 1.0# : 0.0#;", Said::Told},
                {"total = mix(gain, bias, norm);", "total = gain + (bias - gain) * norm;", Said::NoteAtMost},
                {"total = mix(gain, bias, norm);", "total = gain * (1.0# - norm) + bias * norm;", Said::NoteAtMost},
                {"total = mix(gain, bias, norm);", "total = gain + (gain - bias) * norm;", Said::Told},
                {"total = mix(gain, bias, norm);", "total = bias * (1.0# - norm) + gain * norm;", Said::Told},
                {"total = mix(gain, bias, norm);", "total = gain * (2.0# - norm) + bias * norm;", Said::Told},
                {"total = clamp(total, 0.0#, 1.0#);", "total = max(min(total, 0.0#), 1.0#);", Said::Told}});
}

TEST(KindsAndSpellings, CallsWithinEachOtherTakeNoTimeInTheirNumber) {
    const auto nested = [](const std::string& open, const std::string& inner, const std::string& close) {
        constexpr int kDeep = 40;
        std::string out = inner;
        for (int i = 0; i < kDeep; ++i) out = open + out + close;
        return "total = " + out + ";";
    };
    for (const auto& [open, close] : std::vector<std::pair<std::string, std::string>>{{"sqrt(", ")"},
                                                                                      {"own(", ", k)"},
                                                                                      {"max(", ", k, n)"},
                                                                                      {"(", ") + (bias - gain)"},
                                                                                      {"gain + (bias - (", "))"}})
        expect_said(loudest(numbers(kGlsl, nested(open, "gain", close), nested(open, "bias", close))), Said::Told,
                    open);
}

TEST(KindsAndSpellings, ADotProductWrittenOut) {
    const std::string there = "float f(float3 p, float3 q, float2 r, float a) {\n  float s = p.x * a;\n",
                      here = "__device__ " + there, end = "  return s + q.y * r.x;\n}\n";
    const auto said = [&](const std::string& source, const std::string& target) {
        return loudest({{"k.cu", "k.cpp"},
                        {here + end, there + end},
                        {here + "  s += " + source + ";\n" + end, there + "  s += " + target + ";\n" + end}});
    };
    const std::string dot = "dot(p, q)", all = "p.x * q.x + p.y * q.y + p.z * q.z";
    expect_said(said(dot, all), Said::NoteAtMost, "all parts");
    expect_said(said(dot, replaced(all, "p.y * q.y", "q.y * p.y")), Said::NoteAtMost, "the other way round");
    expect_said(said("length(p)", "sqrt(dot(p, p))"), Said::NoteAtMost, "a length");
    expect_said(said(dot, "p.x * q.x + p.y * q.y"), Said::Told, "one part less");
    expect_said(said(dot, replaced(all, "p.z * q.z", "p.z * q.y")), Said::Told, "a part of another");
    expect_said(said(dot, replaced(all, "+ p.z", "- p.z")), Said::Told, "another sign");
    expect_said(said("dot(p, r)", "p.x * r.x + p.y * r.y"), Said::Told, "of unlike vectors");
    expect_said(said("length(p)", "sqrt(dot(p, q))"), Said::Told, "of two");
}

TEST(KindsAndSpellings, AMemberThatIsAnElementThere) {
    const std::string here = "__device__ float f(Range r, float a) {\n  float s = r.lo * a;\n",
                      there = "float f(const float* r, float a) {\n  float s = r[0] * a;\n";
    const auto said = [&](const std::string& source, const std::string& target, const std::string& last) {
        const std::string end = "  return s + r.hi;\n}\n", end_there = "  return s + r[" + last + "];\n}\n";
        return loudest(
            {{"k.cu", "k.cpp"}, {here + end, there + end_there}, {here + source + end, there + target + end_there}});
    };
    expect_said(said("  s *= r.hi - 0.5f;\n", "  s *= r[1] - 0.5f;\n", "1"), Said::NoteAtMost, "the same");
    expect_said(said("  s *= r.hi - 0.5f;\n", "  s *= r[0] - 0.5f;\n", "1"), Said::Told, "the other one");
    expect_said(said("  s *= r.hi - 0.5f;\n", "  s *= r[1] - 0.5f;\n", "0"), Said::Told, "never held apart");
}

/// Both sides come to call or to use what stands before their functions.
std::string after_use(const std::string& in_source, const std::string& in_target, const std::string& use,
                      const std::string& use_there) {
    const auto text = [](const std::string& head, const std::string& more) {
        return head + "float f(float x, int k) {\n  float s = x * 0.5f;\n" + more + "  return s - x;\n}\n";
    };
    return loudest({{"k.glsl", "k.cpp"},
                    {text(in_source, ""), text(in_target, "")},
                    {text(in_source, use), text(in_target, use_there)}});
}

TEST(KindsAndSpellings, WhatCameIntoUseIsTheSameOnBothSides) {
    const auto shape = [](const std::string& body) { return "float shape(float a, float b) { " + body + " }\n"; };
    const auto with_shape = [&](const std::string& source, const std::string& target) {
        const std::string use = "  s += shape(x, s);\n";
        return after_use(shape(source), shape(target), use, use);
    };
    expect_said(with_shape("return a - b;", "return a - b;"), Said::Nothing, "one function");
    expect_said(with_shape("float t = a - b; return t * t;", "float u = a - b; return u * u;"), Said::Nothing,
                "locals");
    expect_said(with_shape("return a - b;", "return b - a;"), Said::Told, "the other way round");
    expect_said(with_shape("return a - b * 3.0f;", "return a - b * 4.0f;"), Said::Told, "another number");
    expect_said(with_shape("float t = a; t *= b; return t;", "float t = a; t /= b; return t;"), Said::Told, "a sign");
    const auto taps = [](const std::string& type) { return "struct Taps { " + type + " w; float h; };\n"; };
    const auto with_taps = [&](const std::string& source, const std::string& target) {
        const std::string use = "  Taps t = taps_of(k);\n  s += t.w / 2;\n";
        return after_use(taps(source), taps(target), use, use);
    };
    expect_said(with_taps("int", "int"), Said::Nothing, "one kind");
    expect_said(with_taps("int", "float"), Said::Told, "a real number");
    expect_said(with_taps("int", "unsigned"), Said::Told, "without a sign");
    expect_said(with_taps("int", "short"), Said::Told, "half as wide");
    for (const auto& [declared, said] :
         std::vector<std::pair<std::string, Said>>{{"typedef float real;\n", Said::Nothing},
                                                   {"using real = float;\n", Said::Nothing},
                                                   {"typedef double real;\n", Said::Told},
                                                   {"using real = double;\n", Said::Told},
                                                   {"#define real double\n", Said::Told}})
        expect_said(after_use("", declared, "  float d = x * 3.0;\n  s += d;\n", "  real d = x * 3.0f;\n  s += d;\n"),
                    said, declared);
}

}  // namespace
}  // namespace porttool::testing::kinds_and_spellings_test

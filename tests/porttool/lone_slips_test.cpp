// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Slips that one text tells: what is one, and what only looks like one.
#include "porttool/audit/lone_slips.h"

#include <gtest/gtest.h>

#include "porttool/audit/past_edit.h"
#include "porttool/normal/normal_form.h"
#include "porttool/scan/scan.h"

namespace porttool::testing::lone_slips_test {
namespace {

/// What is told of a function with such a body; "" for nothing, and what is told of several statements joined by " | ".
std::string told(const std::string& body) {
    const ScannedFile file =
        scan_text("a.cu", "float f(float4 p, float4 q, float* m, int n, int c) {\n" + body + "\n}\n");
    EXPECT_EQ(file.units.size(), 1u) << body;
    const NormalText text = normal_form(file, file.units.at(0));
    std::string out;
    for (const LoneSlip& slip : lone_slips(written_statements(text.words())))
        (out.empty() ? out : out += " | ") += slip.what;
    return out;
}

TEST(LoneSlips, AnOperandOnBothSides) {
    EXPECT_EQ(told("return p.x * q.x - q.y - p.y;"), "");
    EXPECT_EQ(told("return p.x - p.x;"), "has `p . x` on both sides of `-`");
    EXPECT_EQ(told("return f4(p.x - q.x, p.w - p.w);"), "has `p . w` on both sides of `-`");
    EXPECT_EQ(told("if (m[c] >= m[c]) return 1;\nreturn 0;"), "has `m [ c ]` on both sides of `>=`");
    EXPECT_EQ(told("return 2 * m[c] - m[c];"), "");  // of which but a part stands there
    EXPECT_EQ(told("return m[c] - m[c] * n;"), "");
    EXPECT_EQ(told("return m[c++] - m[c++];"), "");               // two elements
    EXPECT_EQ(told("return next(m) - next(m);"), "");             // two answers
    EXPECT_EQ(told("if (p.x != p.x) return 0;\nreturn 1;"), "");  // not a number
    EXPECT_EQ(told("return (n - n) / (n - n);"), "");             // makes one that is none
    EXPECT_EQ(told("return fmaxf(p.x, p.x);"), "takes the `fmaxf` of `p . x` and itself");
    EXPECT_EQ(told("return fmaxf(p.x, p.y);"), "");
}

TEST(LoneSlips, AQuestionThatIsAskedTwice) {
    EXPECT_EQ(told("if (p.x < 0 || p.y < 0 || p.x < 0) return 1;\nreturn 0;"),
              "asks `p . x < 0` twice in one condition");
    EXPECT_EQ(told("if (!(isnan(p.x) && isnan(p.x))) return 1;\nreturn 0;"),
              "asks `isnan ( p . x )` twice in one condition");
    EXPECT_EQ(told("if (p.x < 0 || p.y < 0 || p.x > 0) return 1;\nreturn 0;"), "");
    EXPECT_EQ(told("if ((p.x < 0 && p.y < 0) || (p.x < 0 && p.y > 1)) return 1;\nreturn 0;"), "");
    EXPECT_EQ(told("while (*(m += 2) == 1 && *(m += 2) == 1) n++;\nreturn n;"), "");
    EXPECT_EQ(told("if (take(m) > 0 && take(m) > 0) return 1;\nreturn 0;"), "");
    EXPECT_EQ(told("return n > 0 ? p.x : p.x;"), "gives `p . x` whatever it asks");
    EXPECT_EQ(told("return n > 0 ? p.x : p.y;"), "");
    EXPECT_EQ(told("return n > 0 ? 1 : 1;"), "");  // a number that is to be tuned
}

TEST(LoneSlips, AnotherLoopsVariable) {
    const std::string outer = "for (int i = 0; i < n; i++)\n";
    EXPECT_EQ(told(outer + "for (int j = 0; j < c; j++) m[i * c + j] = 0;\nreturn 0;"), "");
    EXPECT_EQ(told(outer + "for (int j = 0; i < c; j++) m[i * c + j] = 0;\nreturn 0;"),
              "asks `i` in the head of the loop over `j`");
    EXPECT_EQ(told(outer + "for (int j = 0; j < c; i++) m[i * c + j] = 0;\nreturn 0;"),
              "counts `i` in the head of the loop over `j`");
    EXPECT_EQ(told(outer + "for (int j = 0; i + j < c; j++) m[i * c + j] = 0;\nreturn 0;"), "");
    // What the body counts a head may ask.
    EXPECT_EQ(told("int j;\nfor (j = 0; j < n; j++) m[j] = 0;\nj = 0;\nfor (int i = 0; j < c; i++) {\n"
                   "if (m[i] > 0) j++;\n}\nreturn j;"),
              "");
}

TEST(LoneSlips, BehindTheEndOfAnArray) {
    EXPECT_EQ(told("float w[3];\nw[0] = p.x;\nw[3] = p.y;\nreturn w[0];"), "uses `w [ 3 ]`, and `w` has 3 elements");
    EXPECT_EQ(told("float w[3];\nw[0] = p.x;\nw[2] = p.y;\nreturn w[0];"), "");
    EXPECT_EQ(told("float w[3];\nfloat* end = &w[3];\nreturn sum(w, end);"), "");
    EXPECT_EQ(told("float w[3];\nreturn s.w[3] + w[0];"), "");  // another one
    EXPECT_EQ(told("float v[3][4];\nreturn v[0][3];"), "");
    EXPECT_EQ(told("return m[c - 1] + m[+1];"), "has nothing before the `+` in `m [ + 1`");
}

TEST(LoneSlips, AVectorOfWhichAComponentIsNeverSet) {
    const std::string sets = "float4 t;\nt.x = p.x;\nt.y = p.y;\nt.z = q.z;\n";
    EXPECT_EQ(told(sets + "p = p + t;\nreturn p.x;"), "uses all of `t`, of which `w` is never set");
    EXPECT_EQ(told(sets + "p = t;\nreturn p.x;"), "uses all of `t`, of which `w` is never set");
    EXPECT_EQ(told(sets + "t.w = 0;\np = p + t;\nreturn p.x;"), "");
    EXPECT_EQ(told(sets + "return t.x;"), "");                         // not all of it
    EXPECT_EQ(told(sets + "fill(&t);\np = p + t;\nreturn p.x;"), "");  // who knows what it sets
    EXPECT_EQ(told(sets + "fill(t);\np = p + t;\nreturn p.x;"), "");
    EXPECT_EQ(told("float4 t = q;\nt.x = p.x;\nt.y = p.y;\np = p + t;\nreturn p.x;"), "");
}

TEST(LoneSlips, WhatDoesNotGoAlongWithItsNeighbours) {
    const auto three = [](const std::string& last) {
        return told("float4 r;\nr.x = p.x * q.x + c;\nr.y = p.y * q.y + c;\nr.z = " + last + " + c;\nreturn r.x;");
    };
    EXPECT_EQ(three("p.z * q.z"), "");
    EXPECT_EQ(three("p.z * q.y"), "has `q . y` where the statements beside it go along to `z`");
    EXPECT_EQ(three("p.z * q.w"), "");  // no neighbour's
    EXPECT_EQ(told("float4 r;\nr.x = p.y * q.z;\nr.y = p.z * q.x;\nr.z = p.x * q.y;\nreturn r.x;"), "");  // a turn
    EXPECT_EQ(told("m[0] = p.x * n;\nm[1] = p.y * n;\nm[2] = p.y * n;\nreturn 0;"), "");  // by letters alone
    // Numbers that are no element are what they are.
    EXPECT_EQ(told("m[0] = m[0] << 1;\nm[1] = m[1] << 2;\nm[2] = m[2] << 2;\nreturn 0;"), "");
    // Of two statements four words have to go along.
    const std::string x = "float lo_x = min_x * s_x + off_x * p_x;\n";
    const std::string declared = "float min_x, min_y, s_x, s_y, off_x, off_y, p_x, p_y;\n";
    EXPECT_EQ(told(declared + x + "float lo_y = min_y * s_y + off_y * p_x;\nreturn lo_x + lo_y;"),
              "has `off_y * p_x` where the words beside it go along to `p_y`");
    EXPECT_EQ(told(declared + x + "float lo_y = min_y * s_y + off_y * p_y;\nreturn lo_x + lo_y;"), "");
    EXPECT_EQ(told("float u = p.x / q.x;\nfloat v = p.y / q.x;\nreturn u + v;"), "");  // both by the width
    EXPECT_EQ(told("return p.x * q.x + p.y * q.y + p.z * q.y;"),
              "has `q . y` where the terms beside it go along to `z`");
    EXPECT_EQ(told("return p.x * q.x + p.y * q.y + p.z * q.z;"), "");
    EXPECT_EQ(told("return i0 * s0 + i1 * s1 + i2 * s2 * i3 * s3;"),
              "has `*` before the term with `i3`, where the terms beside it have `+`");
    EXPECT_EQ(told("return i0 * s0 + i1 * s1 + i2 * s2 + i3 * s3;"), "");
    EXPECT_EQ(told("return i0 * s0 + i1 * s1 + i2 * s2 * n * c;"), "");
}

}  // namespace
}  // namespace porttool::testing::lone_slips_test

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The worked examples at the top of the headers of normal/ and compare/ say what the code does.
#include <gtest/gtest.h>

#include "porttool/compare/constant_expression.h"
#include "porttool/compare/edits.h"
#include "porttool/compare/positions.h"
#include "porttool/compare/renaming.h"
#include "porttool/compare/same_words.h"
#include "porttool/compare/struct_fields.h"
#include "porttool/compare/values.h"
#include "porttool/normal/declarations.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/locals.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/scan.h"

namespace porttool::worked_examples_test {
namespace {

/// Words of a text that lives on.
Words words(std::string_view text) {
    Words out;
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find(' ', at), text.size());
        if (end > at) out.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return out;
}

std::string joined(const Words& words) {
    std::string out;
    for (const std::string_view word : words) out.append(out.empty() ? "" : " ").append(word);
    return out;
}

ScannedFile scanned(const std::string& text) { return scan_text("a.cu", text); }

TEST(WorkedExamples, NormalText) {
    const ScannedFile file = scanned("void f(int a) {\n    if (a > 0x10) a *= 2.0F;\n}\n");
    const NormalText text = unit_state(file, file.units.at(0)).text;
    EXPECT_EQ(text.recorded(), "void @ ( int a ) {\nif ( a > 16 ) {\na *= 2f ;\n}\n}\n");
    EXPECT_EQ(joined(text.words()), "void @ ( int a ) { if ( a > 16 ) { a *= 2f ; } }");
    EXPECT_EQ(NormalText::read(text.recorded()), text);
    EXPECT_EQ(text[3], "int");
}

TEST(WorkedExamples, WordsWithBlanksAreRecordedAndComeBack) {
    NormalText text;
    for (const char* word : {"f", "(", "a", ";", "\"b c\nd\"", ")", ";", "e"}) text.add(word);
    EXPECT_EQ(text.recorded(),
              "f ( a ; \"b\x02"
              "c\x01"
              "d\" ) ;\ne\n");
    EXPECT_EQ(NormalText::read(text.recorded()), text);
    NormalText own;
    own.add("\"\x01\"");
    EXPECT_NE(NormalText::read(own.recorded()), own);
    const std::string recorded = own.recorded();
    own.as_recorded();
    EXPECT_EQ(NormalText::read(recorded), own);
    EXPECT_EQ(own.recorded(), recorded);
    EXPECT_TRUE(NormalText::read(" \n \n").empty());
}

TEST(WorkedExamples, Declarations) {
    const ScannedFile file = scanned(
        "float shade(Ray ray, float) {\n    float a = 1.0f, *b = nullptr;\n    Hit hit(ray);\n"
        "    for (int i = 0; i < 4; ++i) a * b;\n    return hit.t;\n}\n");
    const Unit& unit = file.units.at(0);
    Words found;
    for (const uint32_t token : declaring_tokens(file.lexed, unit.parameters, unit.body))
        found.push_back(file.lexed.view(token));
    EXPECT_EQ(joined(found), "ray a b hit i");
    const ScannedFile head = scanned("void f(const float *a, int b[4], float (*f)(int), A::B c = d(), int) {\n}\n");
    found.clear();
    for (const uint32_t token : declaring_tokens(head.lexed, head.units.at(0).parameters, head.units.at(0).body))
        found.push_back(head.lexed.view(token));
    EXPECT_EQ(joined(found), "a b f c");
}

TEST(WorkedExamples, Locals) {
    const Words text = words("float @ ( float x ) { if ( x > 0 ) { float y = x ; x = y ; } return y . x ; }");
    std::string numbers;
    for (const size_t number : local_numbers(text))
        if (number > 0) numbers += std::to_string(number);
    EXPECT_EQ(numbers,
              "1121"
              "12");
    EXPECT_EQ(local_numbers(text).at(text.size() - 5), 0u) << "a global y";
    EXPECT_TRUE(local_numbers(words("float @ ( float x ) { # if A x = 1 ; # endif }")).empty());
}

TEST(WorkedExamples, Diff) {
    const Words before = {"a = 1 ;", "b = a ;", "return b ;"}, now = {"a = 1 ;", "c = a ;", "return b ;"};
    std::string steps;
    for (const DiffStep& step : diff(before, now)) steps += "KRA"[step.kind];
    EXPECT_EQ(steps, "KRAK");
}

TEST(WorkedExamples, ConstantExpressions) {
    const Dialect dialect;
    for (const auto& [text, value] : std::vector<std::pair<const char*, const char*>>{
             {"1u << 5", "32"}, {"( int ) 2.5 * 3", "6"}, {"float3 ( 0.5f , 1 , 0 )", "{0.5,1,0}"}, {"1 << BITS", ""}})
        EXPECT_EQ(evaluate_constant(words(text), dialect), value) << text;
}

TEST(WorkedExamples, Values) {
    const Dialect dialect;
    const auto compared = [&](UnitKind kind, const char* source, const char* target) {
        const ComparedValues found = compare_values(kind, words(source), words(target), dialect);
        return std::string(found.same ? "same" : "not") + (found.certain ? "" : " certain");
    };
    EXPECT_EQ(compared(UnitKind::Constant, "# define @ ( 1 < < 5 )", "const uint @ = 32u ;"), "same");
    EXPECT_EQ(compared(UnitKind::Constant, "const float @ = 1 ;", "const float @ = 1.0 ;"), "same");
    EXPECT_EQ(compared(UnitKind::Constant, "# define @ N", "const int @ = 32 ;"), "not certain");
    EXPECT_EQ(compared(UnitKind::Struct, "struct @ { float3 o , d ; } ;", "struct @ { vec3 o ; vec3 d ; } ;"), "same");
    EXPECT_EQ(joined(single_fields(words("struct @ { float3 o , d ; unsigned int k [ 4 ] ; } ;"))),
              "struct @ { float3 o ; float3 d ; uint k [ 4 ] ; } ;");
}

TEST(WorkedExamples, Renaming) {
    const Dialect dialect;
    const auto named = [&](const char* before, const char* now) {
        const std::string head = "float @ ( float x , float y ) { ";
        const std::string old_text = head + before + " }", new_text = head + now + " }";
        return joined(with_old_names(words(old_text), words(new_text), dialect)).substr(head.size());
    };
    EXPECT_EQ(named("float r = x ; return r ;", "float s = x + y ; return s ;"), "float r = x + y ; return r ; }");
    EXPECT_EQ(named("float r = x ; return r ;", "float s = r ; return s ;"), "float s = r ; return s ; }");
}

TEST(WorkedExamples, Meaning) {
    const Words none;
    const Dialect dialect;
    const Words cuda = words("const float3 d = make_float3 ( x , y , z ) * 2f ;");
    const Words glsl = words("vec3 d = vec3 ( x , y , z ) * 2.0 ;");
    const auto translated = [&](Language port, Side side) {
        std::string out;
        const Meaning meaning({none, cuda, none, glsl}, dialect, {Language::Cuda, port});
        for (const std::string& word : meaning.translate(side == Side::Source ? cuda : glsl, side, true))
            out += word + " ";
        return out;
    };
    EXPECT_EQ(translated(Language::Glsl, Side::Source), "vec3 d = vec3 ( x , y , z ) * 2.0 ; ");
    EXPECT_EQ(translated(Language::Glsl, Side::Target), "vec3 d = vec3 ( x , y , z ) * 2.0 ; ");
    EXPECT_EQ(translated(Language::Cpp, Side::Source), "vec3 d = vec3 ( x , y , z ) * 2.0f ; ");
}

StatementEdit edit(const std::string& before, const std::string& now) {
    return statement_edit(words(before), words(now), [](const Words& tokens, bool) {
        return std::vector<std::string>(tokens.begin(), tokens.end());
    });
}

TEST(WorkedExamples, StatementEdits) {
    const StatementEdit found =
        edit("float @ ( ) { a = b ; c = a ; return c ; }", "float @ ( ) { if ( b > 0 ) { a = b ; } return c ; }");
    EXPECT_EQ(found.lost, (std::vector<size_t>{2}));
    EXPECT_EQ(found.gained, (std::vector<size_t>{1, 3}));
    EXPECT_EQ(found.kept(), (std::vector<size_t>{0, 2, StatementEdit::kGone, 4, 5}));
}

TEST(WorkedExamples, Positions) {
    const std::string before = "float @ ( ) { if ( a > 0 ) { a = b ; } return a ; }";
    const StatementEdit inside = edit(before, "float @ ( ) { if ( a > 0 ) { a = b ; a *= 2 ; } return a ; }");
    const StatementEdit after = edit(before, "float @ ( ) { if ( a > 0 ) { a = b ; } a *= 2 ; return a ; }");
    EXPECT_TRUE(other_positions(inside, inside).sentences.empty());
    EXPECT_EQ(other_positions(inside, after).sentences.size(), 1u);
    EXPECT_TRUE(same_words(inside, after));
}

TEST(WorkedExamples, SameWords) {
    const StatementEdit source = edit("d = dot ( n , l ) * k ;", "d = dot ( n , h ) * k ;");
    EXPECT_TRUE(same_words(source, edit("d = k * dot ( n , l ) ;", "d = k * dot ( n , h ) ;")));
    EXPECT_FALSE(same_words(source, edit("d = k * dot ( n , l ) ;", "e = k * dot ( n , h ) ;")));
}

TEST(WorkedExamples, Edits) {
    const Dialect dialect;
    const auto equivalent = [&](const char* source_now, const char* target_now) {
        const std::string head = "float @ ( float a , float b ) { ";
        const std::string before = head + "a = b ; }", source = head + source_now + " }",
                          target = head + target_now + " }";
        const Words old_text = words(before), left = words(source), right = words(target);
        return compare_edits({old_text, left, old_text, right}, dialect, {Language::Cuda, Language::Glsl}).equivalent;
    };
    EXPECT_TRUE(equivalent("a = b * 2f ; float c = a ;", "a = b * 2.0 ; float d = a ;"));
    EXPECT_FALSE(equivalent("a = b * 2f ; float c = a ;", "float c = a ; a = b * 2.0 ;"));
    EXPECT_FALSE(equivalent("a = b * 2f ; float c = a ;", "a = b * 2.0 ;"));
}

}  // namespace
}  // namespace porttool::worked_examples_test

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Classes of edits that the other side seldom needs.
#include <gtest/gtest.h>

#include <functional>
#include <iterator>
#include <sstream>

#include "porttool/audit/components.h"
#include "porttool/audit/edit_class.h"
#include "porttool/audit/message.h"
#include "porttool/audit/same_value.h"
#include "porttool/audit/todays_difference.h"
#include "porttool/scan/scan.h"

namespace porttool::testing::audit_class_test {
namespace {

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

WrittenStatement statement_of(const std::string& text) {
    std::string out;
    for (const std::string& word : words_of(text)) (out.empty() ? out : out += '\x1f') += word;
    return out;
}

MissingPlace replaced_place(const std::string& before, const std::string& now) {
    MissingPlace out;
    out.before = statement_of(before);
    out.now = statement_of(now);
    return out;
}

MissingPlace added_place(const std::string& now) {
    MissingPlace out = replaced_place("", now);
    out.kind = MissingPlace::Kind::Added;
    return out;
}

UnitState unit_of(const std::string& text, const std::string& name = "shade") {
    UnitState out;
    out.name = name;
    NormalText words;
    for (const std::string& word : words_of(text)) words.add(word);
    out.text = std::move(words);
    return out;
}

TEST(AuditClass, NamesThatAFunctionOfThisSideTakesAreHandedOn) {
    const std::set<std::string> own = {"light", "run"};
    struct Row {
        const char *before, *now;
        bool is;
    };
    for (const Row& row :
         {Row{"v = light ( p , n )", "v = light ( p , n , textures )", true},
          Row{"v = light ( p , n )", "v = light ( p , n , scene -> textures )", true},
          Row{"run ( q , seed )", "run ( q )", true}, Row{"v = light ( p , n )", "v = light ( p , n , 0.5f )", false},
          Row{"v = light ( p , n )", "v = light ( p , n * scale )", false},
          Row{"v = light ( p , n )", "v = light ( p , m )", false},
          Row{"v = light ( p , n )", "v = light ( p , n ) * scale", false},
          Row{"v = clamp ( p , n )", "v = clamp ( p , n , m )", false},
          Row{"v = light ( max ( p , n ) )", "v = light ( max ( p , n , m ) )", false}})
        EXPECT_EQ(only_hands_on(replaced_place(row.before, row.now), own), row.is) << row.now;
}

TEST(AuditClass, PointersAreGuardedWhereTheyAreRead) {
    const UnitState unit = unit_of("void shade ( ) { if ( tex ) { v = tex -> x ; } w = * mesh ; u = level ; }");
    EXPECT_TRUE(guards_pointer(added_place("if ( tex )"), unit));
    EXPECT_TRUE(guards_pointer(added_place("if ( ! tex )"), unit));
    EXPECT_TRUE(guards_pointer(added_place("if ( tex && level > 0 )"), unit));
    EXPECT_TRUE(guards_pointer(added_place("if ( ! mesh )"), unit));
    EXPECT_FALSE(guards_pointer(added_place("if ( level )"), unit)) << "a number";
    EXPECT_FALSE(guards_pointer(added_place("if ( tex > 0 )"), unit));
    EXPECT_FALSE(guards_pointer(added_place("while ( tex )"), unit));
}

TEST(AuditClass, LabelsOfOptionsAndOfNumbers) {
    const UnitState reads = unit_of("int parse ( int argc , char * * argv ) { }", "parse"), draws = unit_of("{ }");
    EXPECT_TRUE(is_option(added_place("case 'p' :"), reads));
    EXPECT_TRUE(is_option(added_place("case 'p' :"), unit_of("{ }", "main")));
    EXPECT_FALSE(is_option(added_place("case 'p' :"), draws));
    EXPECT_FALSE(is_option(added_place("case 64 :"), reads));
    const UnitState by_names = unit_of("switch ( f ) { case kBulb : x ; case kBox : y ; }");
    EXPECT_TRUE(numbers_label(added_place("case 64 :"), by_names));
    EXPECT_FALSE(numbers_label(added_place("case kTorus :"), by_names));
    EXPECT_FALSE(numbers_label(added_place("case 64 :"), unit_of("switch ( f ) { case 1 : x ; case kBox : y ; }")));
    EXPECT_FALSE(numbers_label(added_place("case 64 :"), draws)) << "no switch";
}

TEST(AuditClass, BoundsOfAComparisonOfResults) {
    EXPECT_TRUE(sets_tolerance(replaced_place("if ( fabs ( a - b ) > 0.01 )", "if ( fabs ( a - b ) > 0.1 )")));
    EXPECT_FALSE(sets_tolerance(replaced_place("if ( fabs ( a - b ) > 0.01 )", "if ( fabs ( a - c ) > 0.01 )")));
    EXPECT_FALSE(sets_tolerance(replaced_place("if ( fabs ( a ) > 0.01 )", "if ( fabs ( a ) > 0.1 )")))
        << "a threshold";
    EXPECT_FALSE(sets_tolerance(replaced_place("x = fabs ( a - b ) * 0.01", "x = fabs ( a - b ) * 0.1")));
}

TEST(AuditClass, LocalsTypesAddressesAndLaunches) {
    const UnitState unit = unit_of("{ int bucket = 1 ; x = begin [ bucket ] ; }");
    EXPECT_TRUE(takes_other_local(replaced_place("x = begin [ shifted ]", "x = begin [ bucket ]"), unit));
    EXPECT_FALSE(takes_other_local(replaced_place("x = begin [ x ]", "x = begin [ bucket ]"), unit)) << "still there";
    EXPECT_FALSE(takes_other_local(replaced_place("x = old -> n", "x = bucket -> n"), unit)) << "an object";
    EXPECT_TRUE(names_type(replaced_place("using T = A", "using T = B")));
    EXPECT_TRUE(keeps_address(added_place("in . count = & buffer [ i ] . count")));
    EXPECT_FALSE(keeps_address(added_place("x = a & b")));
    EXPECT_FALSE(keeps_address(added_place("x = & a [ i + 1 ]")));
    EXPECT_TRUE(guards_launch(added_place("if ( num_blocks > 0 )")));
    EXPECT_FALSE(guards_launch(added_place("if ( level > 0 )")));
    EXPECT_TRUE(only_waits(statement_of("__syncthreads ( )")));
    EXPECT_TRUE(only_waits(statement_of("barrier ( CLK_LOCAL_MEM_FENCE )")));
    EXPECT_FALSE(only_waits(statement_of("x = level ( )")));
}

TEST(AuditClass, WhatEachRuntimeSaysInItsOwnWay) {
    EXPECT_TRUE(exchanges_in_group(replaced_place("x = tile . shfl_xor ( v , n )", "x = __shfl_xor ( v , n , w )")));
    EXPECT_TRUE(exchanges_in_group(replaced_place("n = warp_size / k", "n = subgroup_size / k")));
    EXPECT_TRUE(exchanges_in_group(added_place("mask = match_any_over_sub_group ( sg , p )")));
    EXPECT_FALSE(exchanges_in_group(replaced_place("x = __shfl_xor ( v , n )", "x = __shfl_xor ( v , n * 2 )")))
        << "a number";
    EXPECT_FALSE(exchanges_in_group(replaced_place("x = group + 1", "x = group + size")));
    EXPECT_TRUE(is_taken_by_runtime(replaced_place("return cudaGraphRun ( g , n )", "return cudaGraphRun ( g )")));
    EXPECT_FALSE(is_taken_by_runtime(replaced_place("return cudaGraphRun ( g )", "return cudaGraphRun ( g ) + n")));
    EXPECT_FALSE(is_taken_by_runtime(replaced_place("return hipster ( g )", "return hipster ( n )")));
    EXPECT_TRUE(asks_for_type(added_place("if constexpr ( sizeof ( T ) == 2 )")));
    EXPECT_FALSE(asks_for_type(added_place("if ( size == 2 )")));
    EXPECT_TRUE(lies_behind_lambda(replaced_place(", n , sizes . get ( ) )", ", n , sizes )")));
    EXPECT_FALSE(lies_behind_lambda(replaced_place("f ( n )", "f ( m )")));
    EXPECT_TRUE(
        asks_for_memory(replaced_place("if ( a -> size ( ) > 0 )", "if ( a -> size ( ) > 0 && b -> get_values ( ) )")));
    EXPECT_FALSE(asks_for_memory(replaced_place("if ( n > 0 )", "if ( n > 0 && b -> get_values ( ) [ 0 ] > 1 )")));
    EXPECT_FALSE(asks_for_memory(replaced_place("if ( n > 0 )", "if ( n > 0 && is_open ( ) )")));
}

TEST(AuditClass, NamesForWhatStoodThere) {
    const UnitState there = unit_of("{ size = 4 * w * h ; mean /= 4 * w * h * factor ; }");
    EXPECT_TRUE(names_expression(replaced_place("m /= ( 4 * w * h * f )", "m /= ( size * f )"), there));
    EXPECT_FALSE(names_expression(replaced_place("m /= ( 4 * w * h * f )", "m /= ( area * f )"), there)) << "unknown";
    EXPECT_FALSE(names_expression(replaced_place("m /= ( w * f )", "m /= ( size * f )"), there)) << "another name";
    EXPECT_FALSE(names_expression(replaced_place("m /= ( 4 * w * h * f )", "m /= ( size * 2 )"), there));
    const UnitState unit = unit_of("{ read ( e ) ; e = - q * e ; }");
    EXPECT_TRUE(goes_on_from_itself(replaced_place("float e = - q * factor", "e = - q * e"), unit));
    EXPECT_FALSE(goes_on_from_itself(replaced_place("e = - q * factor", "e = - q * r"), unit));
    EXPECT_FALSE(goes_on_from_itself(replaced_place("e = - q * q", "e = - q * e"), unit)) << "still there";
    MissingPlace place = replaced_place("if ( n > MOST )", "if ( n > most_steps )");
    place.there = place.before;
    EXPECT_TRUE(takes_macro_of_host(place, {"MOST"}));
    EXPECT_FALSE(takes_macro_of_host(place, {"LEAST"}));
    std::set<std::string> given;
    const std::string host = "void f() { add(\" -DMOST=\" + text(n)); add(\"-D LEAST=1 -DOPEN -I.\"); }";
    add_macros_of_host(scan_text("host.cpp", host), given);
    EXPECT_EQ(given, (std::set<std::string>{"MOST", "LEAST"}));
}

TEST(AuditClass, MessagesOfThreadsAndOfDigits) {
    EXPECT_TRUE(read_message("Fix a data race in the reduction").threads);
    EXPECT_FALSE(read_message("Fix the trace of rays").threads);
    EXPECT_TRUE(read_message("Corrected limits\n\nneeded for single precision").platform);
    EXPECT_TRUE(read_message("Review updates").manner);
}

TEST(AuditValues, TruthsThatAreOpposite) {
    struct Row {
        const char *a, *b;
        bool opposite;
    };
    // By De Morgan.
    for (const Row& row :
         {Row{"if ( a < b )", "if ( a >= b )", true}, Row{"if ( a < b )", "if ( b <= a )", true},
          Row{"if ( a < b )", "if ( a > b )", false}, Row{"if ( a <= i || ( i < b ) )", "if ( i < a && i >= b )", true},
          Row{"if ( a <= i || i < b )", "if ( i <= a && i >= b )", false},
          Row{"if ( a <= i || i < b )", "if ( i < a || i >= b )", false},
          Row{"if ( a == b && c )", "if ( a != b || ! c )", true}, Row{"if ( a )", "if ( - a )", false},
          Row{"while ( a < b )", "while ( a >= b )", false}}) {
        EXPECT_EQ(ask_the_opposite(words_of(row.a), words_of(row.b)), row.opposite) << row.a << "   " << row.b;
        EXPECT_EQ(ask_the_opposite(words_of(row.b), words_of(row.a)), row.opposite) << row.b << "   " << row.a;
    }
}

TEST(AuditValues, CastsDoNotCount) {
    struct Row {
        const char *a, *b;
        bool same;
    };
    for (const Row& row :
         {Row{"if ( c < - 1.0 )", "if ( c < - Real ( 1.0 ) )", true},
          Row{"w *= Real ( 3.0 / 2.0 )", "w *= Real ( 3.0 ) / Real ( 2.0 )", true},
          Row{"x = static_cast < double > ( n ) * 2.0", "x = n * 2.0", true},
          Row{"x = static_cast < double > ( n + m ) * 2.0", "x = n + m * 2.0", false},
          Row{"x = first ( 0 )", "x = last ( 0 )", false}, Row{"x = Real ( 1.0 )", "x = Real ( 2.0 )", false},
          Row{"x = load ( 2.0 ) + load ( i )", "x = 2.0 + load ( i )", false}})
        EXPECT_EQ(give_the_same_value(words_of(row.a), words_of(row.b)), row.same) << row.a << "   " << row.b;
    EXPECT_FALSE(give_the_same_value(words_of("x = a * ( 3 / 2 )"), words_of("x = a * 3 / 2"))) << "perhaps integers";
    EXPECT_TRUE(give_the_same_value(words_of("x = a * ( 3 / 2 )"), words_of("x = a * 3 / 2"), true));
}

// A run is one but for the component, which is the same throughout a statement.
TEST(AuditComponents, AreOneVectorWhereTheyDoTheSame) {
    const auto runs = [](const std::vector<std::string>& statements) {
        std::vector<std::vector<std::string>> words;
        for (const std::string& one : statements) words.push_back(words_of(one));
        std::string out;
        for (const ComponentRun& run : component_runs(words))
            out += std::to_string(run.first) + "-" + std::to_string(run.end) + " ";
        return out;
    };
    EXPECT_EQ(runs({"c . x = c . x * k", "c . y = c . y * k", "c . z = c . z * k", "d = k"}), "0-3 ");
    EXPECT_EQ(runs({"d = k", "c . r = k", "c . g = k", "c . a = k", "c . r = n"}), "1-4 ");
    EXPECT_EQ(runs({"c . R = k", "c . G = k", "e . x = k", "e . y = k"}), "0-2 2-4 ");
    EXPECT_EQ(runs({"c . w = k", "c . x = k", "c . y = k"}), "1-3 ");
    EXPECT_EQ(runs({"c . x = k"}), "");                       // alone
    EXPECT_EQ(runs({"c . x = e . x", "c . y = e . x"}), "");  // the wrong one
    EXPECT_EQ(runs({"c . x = e . y", "c . y = e . z"}), "");  // they change places
    EXPECT_EQ(runs({"c . x = 1", "c . y = 2"}), "");          // not the same
    EXPECT_EQ(runs({"c . y = k", "c . x = k"}), "");          // another order
    EXPECT_EQ(runs({"o . x ( )", "o . y ( )"}), "");          // calls
}

TEST(AuditSlips, OneSideHasAnOperandMore) {
    const auto more = [](const std::string& a, const std::string& b) -> std::string {
        const auto found = operand_more(words_of(a), words_of(b));
        if (!found) return "none";
        std::string out = found->first_has_it ? "first:" : "second:";
        for (const std::string& word : found->words) out += " " + word;
        return out;
    };
    EXPECT_EQ(more("a = b * k", "a = b"), "first: * k");
    EXPECT_EQ(more("a = b", "a = b / 256"), "second: / 256");
    EXPECT_EQ(more("if ( a > b && open )", "if ( a > b )"), "first: && open");
    EXPECT_EQ(more("a = min ( b , 1 )", "a = b"), "first: min ( , 1 )");
    EXPECT_EQ(more("a = b / ( c * d )", "a = b / c"), "first: ( * d )");
    EXPECT_EQ(more("a = - b", "a = b"), "first: -");
    EXPECT_EQ(more("a = b * k", "c = b"), "none");              // another variable
    EXPECT_EQ(more("a = b * k", "a = d"), "none");              // more than that
    EXPECT_EQ(more("a = b", "a = b"), "none");                  // the same
    EXPECT_EQ(more("a = f ( b , c )", "a = f ( b )"), "none");  // an argument
    EXPECT_EQ(more("if ( ! a )", "if ( a )"), "none");          // its opposite
    EXPECT_EQ(more("a = f ( b )", "a = b"), "none");            // a call
    EXPECT_EQ(more("a = b * ( c", "a = b"), "none");            // half of a bracket
}

}  // namespace
}  // namespace porttool::testing::audit_class_test

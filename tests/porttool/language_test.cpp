// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The table of words and the rows of languages, held to what the languages' own manuals say.
#include "porttool/language/language.h"

#include <gtest/gtest.h>

#include "porttool/language/words.h"

namespace porttool::testing::language_test {
namespace {

TEST(LanguageOfPath, TheLongestSuffixCounts) {
    EXPECT_EQ(language_of_path("src/trace.cpp"), Language::Cpp);
    EXPECT_EQ(language_of_path("src/trace.dp.cpp"), Language::Sycl);
    EXPECT_EQ(language_of_path("src/trace.hip.cpp"), Language::Hip);
    EXPECT_EQ(language_of_path("SRC/TRACE.CU"), Language::Cuda);
    EXPECT_EQ(language_of_path("shaders/node_mix.osl"), Language::Osl);
    EXPECT_EQ(language_of_path("osl"), Language::Unknown);
    EXPECT_EQ(language_of_path("notes.txt"), Language::Unknown);
}

TEST(Abilities, AreThoseOfTheLanguage) {
    EXPECT_TRUE(traits_of(Language::Sycl).std_library);
    EXPECT_FALSE(traits_of(Language::Metal).std_library) << "Metal has metal_stdlib";
    EXPECT_TRUE(traits_of(Language::Metal).references);
    EXPECT_TRUE(traits_of(Language::C).c_libraries);
    EXPECT_FALSE(traits_of(Language::C).std_library);
    EXPECT_TRUE(traits_of(Language::Ispc).pointers);
    for (const Language language : {Language::Glsl, Language::Hlsl, Language::Slang, Language::Osl}) {
        EXPECT_TRUE(traits_of(language).macros);
        EXPECT_EQ(traits_of(language).vectors, language != Language::Osl);
        EXPECT_TRUE(traits_of(language).is_of_devices);
        EXPECT_FALSE(traits_of(language).pointers || traits_of(language).references);
    }
    for (const Language language : {Language::C, Language::Cpp, Language::Cuda, Language::Ispc})
        EXPECT_FALSE(traits_of(language).is_of_devices) << "has double wherever it runs";
    for (const Language language : {Language::Cpp, Language::Cuda, Language::Hip})
        EXPECT_FALSE(traits_of(language).vectors) << "a project's own type may be called float4 there";
    EXPECT_FALSE(traits_of(Language::Unknown).macros);
}

/// `kernel` begins a kernel in OpenCL and Metal, and is a name like any other in C++.
TEST(Words, AreMoreInSomeLanguagesThanInOthers) {
    EXPECT_TRUE(roles_of("kernel", Language::Metal) & kKernel);
    EXPECT_TRUE(roles_of("kernel", Language::OpenCl) & kKernel);
    EXPECT_FALSE(roles_of("kernel", Language::Cpp) & kKernel);
    EXPECT_FALSE(word_is("kernel", kKernel));
    EXPECT_TRUE(roles_of("surface", Language::Osl) & kKernel);
    EXPECT_FALSE(roles_of("surface", Language::Glsl) & kKernel);
    EXPECT_TRUE(roles_of("__global__", Language::Cuda) & kKernel);
    EXPECT_TRUE(roles_of("constant", Language::Metal) & kConstant);
    EXPECT_TRUE(roles_of("constant", Language::Metal) & kSoftQualifier) << "what it is everywhere it is there, too";
    EXPECT_FALSE(roles_of("constant", Language::Slang) & kConstant);
}

TEST(Words, NamesHaveNoRoles) {
    for (const char* name : {"", "x", "shade", "If", "ifs", "constants", "a_name_longer_than_any_word_of_the_table"})
        EXPECT_EQ(roles_of(name), 0u) << name;
}

TEST(Words, EachIsFoundAgain) {
    size_t bits = 0;
    for (Roles role = 1; role <= kLoop; role *= 2) {
        const auto words = words_with(static_cast<WordRole>(role));
        for (const std::string_view word : words) EXPECT_TRUE(word_is(word, role)) << word;
        bits += words.empty() ? 0 : 1;
    }
    EXPECT_EQ(bits, 37u) << "each role is some word's";
}

TEST(Words, TypesOfNumbersVectorsAndMatrices) {
    for (const char* type : {"float", "uint3", "mat4", "mat4x3", "half4", "sampler2D"})
        EXPECT_TRUE(is_type_word(type)) << type;
    for (const char* name : {"vec", "vec5", "vec1", "x2", "2", "mat4x", "floats2", "float16x2", "color"})
        EXPECT_FALSE(is_type_word(name)) << name;
}

}  // namespace
}  // namespace porttool::testing::language_test

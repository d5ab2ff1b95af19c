// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/language/words.h"

#include <algorithm>
#include <array>

#include "porttool/language/word_list.h"

namespace porttool {
namespace {

using Languages = uint32_t;  ///< a bit each
constexpr Languages kEverywhere = ~Languages{0};

template <class... Each>
constexpr Languages in(Each... each) {
    return ((Languages{1} << static_cast<unsigned>(each)) | ...);
}

/// Words of one kind: all roles that they have, in the languages named. The same word has a second row where it is more
/// in some languages than elsewhere.
struct WordRow {
    std::string_view words;
    Roles roles;
    Languages languages = kEverywhere;
};

constexpr Roles kStatement = kNoFunctionName | kGoesOn | kNoType | kKeyword;
constexpr Roles kNumber = kNoFunctionName | kType | kTypePart;
constexpr Roles kDroppedName = kReserved | kDropped;

constexpr std::array kRows = {
    // Statements.
    WordRow{"if", kStatement | kShapeWord | kBlockHead | kControls | kConditionHead | kOwnScope},
    WordRow{"while", kStatement | kShapeWord | kBlockHead | kControls | kConditionHead | kOwnScope | kLoop},
    WordRow{"for", kStatement | kShapeWord | kBlockHead | kControls | kLoopHead | kOwnScope | kLoop},
    WordRow{"switch", kStatement | kShapeWord | kBlockHead | kConditionHead | kOwnScope},
    WordRow{"else", kStatement | kShapeWord | kBlockHead},
    WordRow{"do", kStatement | kShapeWord | kBlockHead | kLoop},
    WordRow{"case", kStatement | kShapeWord},
    WordRow{"default", kStatement | kShapeWord | kLabel},
    WordRow{"return", kStatement | kShapeWord | kNoConstant},
    WordRow{"break", kGoesOn | kNoType | kKeyword | kShapeWord},
    WordRow{"catch", kStatement | kOwnScope},
    WordRow{"cif", kNoFunctionName | kControls | kConditionHead},
    WordRow{"cwhile", kNoFunctionName | kControls | kConditionHead | kLoop},
    WordRow{"cfor", kNoFunctionName | kControls | kLoopHead | kLoop},
    WordRow{"cdo", kLoop},
    WordRow{"foreach", kNoFunctionName | kControls | kKeyword | kLoop},
    WordRow{"foreach_tiled foreach_unique foreach_active", kNoFunctionName | kLoop},
    WordRow{"continue true false", kNoType | kKeyword | kShapeWord},
    WordRow{"goto", kNoFunctionName | kNoType | kKeyword | kNoConstant},
    WordRow{"new delete", kNoFunctionName | kNoType | kKeyword},
    WordRow{"operator nullptr", kNoType | kKeyword},
    WordRow{"try", kNoType | kKeyword | kTrailer},
    WordRow{"throw sizeof", kNoType | kKeyword | kTakesArguments},
    WordRow{"asm alignof", kNoType | kTakesArguments},
    WordRow{"typeid", kNoFunctionName | kNoType},
    WordRow{"co_return co_await co_yield not and or xor compl bitand bitor not_eq and_eq or_eq xor_eq", kNoType},

    // Declarations.
    WordRow{"struct", kNoFunctionName | kOpensType | kRecord | kKeyword | kShapeWord},
    WordRow{"class union enum", kNoFunctionName | kOpensType | kRecord | kKeyword},
    WordRow{"interface tbuffer __interface extension", kOpensType},
    WordRow{"using typedef namespace", kNoFunctionName | kNoType | kNoConstant | kKeyword},
    WordRow{"friend", kNoType | kNoConstant | kKeyword},
    WordRow{"static_assert", kNoFunctionName | kNoConstant | kKeyword},
    WordRow{"concept", kNoConstant},
    WordRow{"template", kNoFunctionName | kNoType | kDroppedName},
    WordRow{"this", kNoType | kDroppedName},
    WordRow{"extern", kNoType | kDroppedName | kHeadPromise},
    WordRow{"public private protected", kLabel | kKeyword},
    WordRow{"signals slots Q_SIGNALS Q_SLOTS", kLabel},
    WordRow{"define elif endif ifdef ifndef import module discard", kKeyword},
    WordRow{"defined", kNoFunctionName | kKeyword},
    WordRow{"decltype typeof __typeof__", kTakesArguments | kTypeOfValue},

    // Attributes.
    WordRow{"alignas _Alignas __attribute__ __declspec __align__", kTakesArguments | kGroupedQualifier},
    WordRow{"layout", kTakesArguments | kGroupedQualifier | kDropped},
    WordRow{"__launch_bounds__", kTakesArguments | kDropped},
    WordRow{"explicit", kTakesArguments | kKeyword},
    WordRow{"noexcept", kTakesArguments | kTrailer | kNoType | kDroppedName | kHeadPromise},
    WordRow{"__attribute __asm__ __pragma _Pragma __cluster_dims__ __maxnreg__ requires packoffset local_size "
            "reqd_work_group_size",
            kTakesArguments},
    WordRow{"override", kTrailer | kDroppedName | kHeadPromise},
    WordRow{"final", kTrailer | kDropped | kHeadPromise},
    WordRow{"abstract pure sealed CONST", kTrailer},
    WordRow{"unmasked", kTrailer | kSoftQualifier | kKeyword},
    WordRow{"virtual", kDroppedName},
    WordRow{"SYCL_EXTERNAL", kDroppedName | kHeadPromise},
    WordRow{"nodiscard", kDroppedName | kIdleAttribute},
    WordRow{"maybe_unused", kDropped | kIdleAttribute},
    WordRow{"always_inline noinline gnu_inline unused used nothrow leaf visibility cold hot deprecated stdcall "
            "cdecl fastcall vectorcall dllexport dllimport warn_unused_result fallthrough likely unlikely flatten "
            "opencl_unroll_hint vec_type_hint unroll dont_unroll loop branch",
            kIdleAttribute},
    WordRow{"__stdcall __cdecl __fastcall __vectorcall", kHeadPromise},

    // Types.
    WordRow{"void auto", kNoFunctionName | kType | kKeyword},
    WordRow{"float bool", kNoFunctionName | kType | kTypeOfVectors},
    WordRow{"int", kNumber | kTypeOfVectors},
    WordRow{"unsigned signed", kNumber},
    WordRow{"char short long", kNumber | kTypeOfVectors | kNumberType | kKeyword},
    WordRow{"double", kNoFunctionName | kType | kTypeOfVectors | kNumberType | kKeyword},
    WordRow{"half uint uchar ushort ulong", kType | kTypeOfVectors},
    WordRow{"vec ivec uvec bvec dvec f16vec mat dmat longlong ulonglong", kTypeOfVectors},
    WordRow{"size_t wchar_t _Bool char8_t char16_t char32_t ptrdiff_t int8_t int16_t int32_t int64_t uint8_t uint16_t "
            "uint32_t uint64_t intptr_t uintptr_t int16 int64 uint8 uint16 uint32 uint64 Vec2f Vec3f Vec4f Vec3fa "
            "Vec3ff Vector3f sampler2D",
            kType},
    WordRow{"int8", kType | kNumberType},

    // Qualifiers and address spaces.
    WordRow{"const", kNoFunctionName | kTrailer | kConstant | kQualifier | kConstantStorage | kDroppedName | kPromise},
    WordRow{"constexpr", kNoFunctionName | kConstant | kQualifier | kConstantStorage | kDroppedName | kPromise},
    WordRow{"__constant__ __constant", kConstant | kQualifier | kConstantStorage | kDropped},
    WordRow{"constinit", kConstant | kQualifier},
    WordRow{"consteval", kConstant},
    WordRow{"CLK_LOCAL_MEM_FENCE", kDroppedName},
    WordRow{"volatile", kNoFunctionName | kTrailer | kQualifier | kDroppedName},
    WordRow{"mutable", kTrailer | kQualifier | kDroppedName},
    WordRow{"restrict", kTrailer | kQualifier | kDroppedName | kHeadPromise},
    WordRow{"register", kTakesArguments | kQualifier | kDroppedName | kPromise},
    WordRow{"static inline", kQualifier | kDroppedName | kHeadPromise},
    WordRow{"typename", kQualifier | kDroppedName | kPromise},
    WordRow{"thread_local", kQualifier},
    WordRow{"__restrict __restrict__ __device__", kQualifier | kDropped | kHeadPromise},
    WordRow{"__global __private highp mediump lowp precise", kQualifier | kDropped},
    WordRow{"__shared__ __local", kQualifier | kSharedStorage | kDropped},
    WordRow{"shared", kBlockStorage | kSoftQualifier | kSharedStorage | kDropped},
    WordRow{"local threadgroup", kSoftQualifier | kSharedStorage | kDropped},
    WordRow{"groupshared", kSoftQualifier | kSharedStorage},
    WordRow{"constant", kSoftQualifier | kConstantStorage | kDropped},
    WordRow{"constant", kConstant, in(Language::OpenCl, Language::Metal)},
    WordRow{"global device thread flat export", kSoftQualifier | kDropped},
    WordRow{"nointerpolation row_major column_major", kSoftQualifier},
    WordRow{"uniform varying in out inout", kBlockStorage | kSoftQualifier | kDropped},
    WordRow{"buffer", kBlockStorage | kDropped},
    WordRow{"cbuffer", kBlockStorage | kOpensType},
    WordRow{"attribute rayPayloadEXT rayPayloadInEXT hitAttributeEXT callableDataEXT callableDataInEXT "
            "taskPayloadSharedEXT perprimitiveEXT",
            kBlockStorage},

    // Kernels.
    WordRow{"__global__ __kernel", kKernel | kKernelMacro | kDropped},
    WordRow{"RT_PROGRAM", kKernel},
    WordRow{"__raygen__ __GLOBAL__ __kernel__", kKernelMacro},
    WordRow{"numthreads shader", kKernelAttribute},
    WordRow{"kernel", kKernelAttribute | kDropped},
    WordRow{"kernel", kKernel, in(Language::OpenCl, Language::Metal)},
    WordRow{"vertex fragment", kKernel, in(Language::Metal)},
    WordRow{"task", kDropped},
    WordRow{"task export", kKernel, in(Language::Ispc)},
    WordRow{"shader surface displacement volume light", kKernel, in(Language::Osl)},

    // What has no counterpart.
    WordRow{"__host__ __forceinline__ __forceinline __inline__ __inline __noinline__", kDropped | kHeadPromise},
    WordRow{"readonly writeonly coherent dpct sycl std glm", kDropped},
};

struct Entry {
    std::string_view word;
    Roles roles = 0;
    Languages languages = 0;
};

constexpr size_t count_words() {
    size_t count = 0;
    for (const WordRow& row : kRows) for_each_word(row.words, [&](std::string_view) { ++count; });
    return count;
}

/// Where the search for a word begins. The factors keep any two words apart, or three at most together.
constexpr size_t kSlots = 1024;
constexpr size_t slot_of(std::string_view word) {
    const auto byte = [&](size_t at) { return static_cast<uint32_t>(static_cast<unsigned char>(word[at])); };
    const size_t size = word.size();
    const uint32_t hash = byte(0) * 48496u + byte(size / 2) * 52633u + byte(size - 1) * 51658u +
                          byte((size - 1) / 3) * 11410u + static_cast<uint32_t>(size) * 3186u;
    return (hash >> 7) % kSlots;
}

/// The rows word by word, found by hashing: made by the compiler, and searched without allocating.
struct WordTable {
    std::array<Entry, count_words()> entries{};
    std::array<uint16_t, kSlots> slots{};  ///< number of the entry, from 1; 0 is free
    size_t longest = 0;

    constexpr WordTable() {
        size_t count = 0;
        for (const WordRow& row : kRows)
            for_each_word(row.words, [&](std::string_view word) {
                entries[count++] = {word, row.roles, row.languages};
                size_t slot = slot_of(word);
                while (slots[slot] != 0) slot = (slot + 1) % kSlots;
                slots[slot] = static_cast<uint16_t>(count);
                longest = std::max(longest, word.size());
            });
    }

    /// The roles that hold in all of `languages`.
    constexpr Roles find(std::string_view word, Languages languages) const {
        Roles roles = 0;
        if (word.empty() || word.size() > longest) return roles;
        for (size_t slot = slot_of(word); slots[slot] != 0; slot = (slot + 1) % kSlots)
            if (const Entry& entry = entries[slots[slot] - 1]; entry.word == word)
                roles |= (entry.languages & languages) == languages ? entry.roles : 0;
        return roles;
    }

    /// No word has two rows for the same languages.
    constexpr bool is_sound() const {
        for (const Entry& a : entries)
            for (const Entry& b : entries)
                if (&a != &b && a.word == b.word && a.languages == b.languages) return false;
        return true;
    }
};

constexpr WordTable kWords;
static_assert(kWords.is_sound());

}  // namespace

Roles roles_of(std::string_view word) { return kWords.find(word, kEverywhere); }

Roles roles_of(std::string_view word, Language language) { return kWords.find(word, in(language)); }

bool is_type_word(std::string_view word) {
    if (word_is(word, kType)) return true;
    size_t end = word.size();
    const auto digit = [&](size_t i) { return word[i] >= '2' && word[i] <= '4'; };
    if (end > 3 && digit(end - 1) && word[end - 2] == 'x' && digit(end - 3)) end -= 2;
    return end > 1 && digit(end - 1) && word_is(word.substr(0, end - 1), kTypeOfVectors);
}

std::vector<std::string_view> words_with(WordRole role) {
    std::vector<std::string_view> out;
    for (const Entry& entry : kWords.entries)
        if ((entry.roles & role) != 0 && entry.languages == kEverywhere) out.push_back(entry.word);
    return out;
}

}  // namespace porttool

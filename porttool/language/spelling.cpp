// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/language/spelling.h"

#include <algorithm>
#include <array>

#include "porttool/language/word_list.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// A spelling and, separated by blanks, the others.
struct SpellingRow {
    std::string_view name, others;
};

// `long` and `ulong` have as many bits as the platform says, except in OpenCL: they are in no row here.
constexpr std::array kTypeSpellings = {
    SpellingRow{"int", "int32_t signed cl_int"},
    SpellingRow{"uint", "unsigned uint32_t u_int u_int32_t cl_uint"},
    SpellingRow{"int8_t", "cl_char"},
    SpellingRow{"uint8_t", "uchar u_char cl_uchar u_int8_t"},
    SpellingRow{"short", "int16_t cl_short"},
    SpellingRow{"uint16_t", "ushort u_short cl_ushort u_int16_t"},
    SpellingRow{"int64_t", "int64 longlong cl_long"},
    SpellingRow{"uint64_t", "uint64 ulonglong cl_ulong u_int64_t"},
    SpellingRow{"float", "cl_float float32_t"},
    SpellingRow{"double", "cl_double float64_t"},
    SpellingRow{"bool", "_Bool"},
    SpellingRow{"size_t", ""},
};

constexpr std::array kOtherSpellings = {
    SpellingRow{"nullptr", "NULL"},
    SpellingRow{"restrict", "__restrict __restrict__"},
};

constexpr std::array kOpenClSpellings = {
    SpellingRow{"__kernel", "kernel"},         SpellingRow{"__global", "global"},
    SpellingRow{"__local", "local"},           SpellingRow{"__constant", "constant"},
    SpellingRow{"__private", "private"},       SpellingRow{"__read_only", "read_only"},
    SpellingRow{"__write_only", "write_only"}, SpellingRow{"int64_t", "long"},
    SpellingRow{"uint64_t", "ulong"},
};

template <size_t size>
std::string_view found_in(const std::array<SpellingRow, size>& rows, std::string_view word) {
    std::string_view found;
    for (const SpellingRow& row : rows) {
        if (row.name == word) return row.name;
        for_each_word(row.others, [&](std::string_view other) {
            if (other == word) found = row.name;
        });
    }
    return found;
}

}  // namespace

std::string_view one_spelling(std::string_view word, Language language) {
    if (language == Language::OpenCl)
        if (const std::string_view found = found_in(kOpenClSpellings, word); !found.empty()) return found;
    if (const std::string_view found = found_in(kTypeSpellings, word); !found.empty()) return found;
    const std::string_view found = found_in(kOtherSpellings, word);
    return found.empty() ? word : found;
}

bool names_inlining(std::string_view word) {
    constexpr std::string_view kInline = "INLINE";
    const auto small = [](char c) { return c >= 'a' && c <= 'z'; };
    if (std::any_of(word.begin(), word.end(), small)) return false;
    const size_t found = word.find(kInline);
    if (found == std::string_view::npos) return false;
    const size_t end = found + kInline.size();
    const std::string_view before = word.substr(0, found);
    const bool starts = before.empty() || before.back() == '_' || before.ends_with("FORCE") || before.ends_with("NO") ||
                        before.ends_with("ALWAYS") || before.ends_with("NEVER");
    return starts && (end == word.size() || word[end] == '_');
}

bool has_other_spellings(std::string_view type) { return !found_in(kTypeSpellings, type).empty(); }

bool names_precision(std::string_view scope) {
    return is_one_of(scope, {"native", "half_precision", "precise", "fast"});
}

}  // namespace porttool

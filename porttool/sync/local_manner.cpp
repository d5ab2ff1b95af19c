// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/local_manner.h"

#include <algorithm>
#include <string_view>

#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

constexpr uint32_t kLongestBody = 5000;  ///< of a function that is looked into, in tokens

/// True where a name is changed, or handed to who could change it.
bool may_change(const LexedText& lexed, uint32_t at) {
    const std::string_view before = lexed.view(at - 1), after = lexed.view(at + 1);
    if (is_one_of(before, {"&", "++", "--"})) return true;
    if (is_one_of(after,
                  {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>=", "++", "--", "[", ".", "->"}))
        return true;
    return is_one_of(before, {"(", ","}) && is_one_of(after, {")", ","});
}

}  // namespace

std::vector<uint32_t> constant_locals(const ScannedFile& file, const Unit& unit, bool is_const) {
    const LexedText& lexed = file.lexed;
    std::vector<uint32_t> out;
    for (uint32_t i = unit.body.first; i + 4 < unit.body.end; ++i) {
        if (!is_one_of(lexed.view(i - 1), {"{", "}", ";"})) continue;
        const uint32_t type = lexed.view(i) == "const" ? i + 1 : i, name = type + 1;
        const bool declares = lexed.tokens[type].kind == TokenKind::Identifier &&
                              lexed.tokens[name].kind == TokenKind::Identifier && lexed.view(name + 1) == "=";
        if (!declares || (type != i) != is_const) continue;
        bool changes = false;
        for (uint32_t k = name + 2; k + 1 < unit.body.end && !changes; ++k)
            changes = lexed.view(k) == lexed.view(name) && may_change(lexed, k);
        if (!changes) out.push_back(i);
    }
    return out;
}

bool adds_const(const ScannedFile& source, const ScannedFile& target) {
    const auto count = [](const ScannedFile& file, bool is_const) {
        size_t out = 0;
        for (const Unit& unit : file.units)
            if ((unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel) &&
                unit.body.end - unit.body.first < kLongestBody)
                out += constant_locals(file, unit, is_const).size();
        return out;
    };
    constexpr size_t kFew = 3, kMost = 9;
    const size_t says = count(target, true);
    return says >= kFew && says >= kMost * count(target, false) && count(source, false) > kMost * count(source, true);
}

}  // namespace porttool

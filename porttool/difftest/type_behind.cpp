// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/type_behind.h"

#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// A pointer's type without what qualifies it, from `first` to before the `*` at `star`; "" where it is none to a
/// value.
std::string pointee(const ScannedFile& file, uint32_t first, uint32_t star, const CppManner& manner) {
    const LexedText& lexed = file.lexed;
    while (first < star &&
           (lexed.view(first) == "const" || lexed.view(first) == "volatile" || lexed.view(first).starts_with("__")))
        ++first;
    uint32_t end = star;
    while (end > first && lexed.view(end - 1) == "const") --end;
    for (uint32_t i = first; i < end; ++i)
        if (lexed.tokens[i].kind != TokenKind::Identifier && lexed.view(i) != "::") return {};
    if (first == end || is_one_of(lexed.view(end - 1), {"void", "char"})) return {};
    return cpp_text_of(file, {first, end}, manner);
}

/// Back over what may stand between a `*` and what follows it.
uint32_t back_over_qualifiers(const LexedText& lexed, uint32_t i) {
    while (i > 0 &&
           (lexed.view(i) == "const" || lexed.view(i) == "restrict" || lexed.view(i).starts_with("__restrict")))
        --i;
    return i;
}

/// The token behind which a statement or a bracket began, before `i`.
uint32_t before_start(const LexedText& lexed, uint32_t i) {
    while (i > 0 && !is_one_of(lexed.view(i), {";", "{", "}", "(", "<"})) --i;
    return i;
}

}  // namespace

std::string type_behind(const Definition& function, std::string_view name, const CppManner& manner) {
    const ScannedFile& file = *function.file;
    const LexedText& lexed = file.lexed;
    const TokenRange body = function.unit->body;
    for (uint32_t i = body.first + 1; i < body.end; ++i) {
        if (lexed.view(i) != name || lexed.tokens[i].kind != TokenKind::Identifier) continue;
        uint32_t last = i - 1;
        if (lexed.view(last) == "(" && lexed.view(last - 1) == ">")
            last -= 2;  // _cast<T*>(name)
        else if (lexed.view(last) == ")")
            --last;  // (T*) name
        else if (lexed.view(last) == "=" && lexed.view(i + 1) == ";")
            last -= 2;  // T* b = name;
        else
            continue;
        const uint32_t star = back_over_qualifiers(lexed, last);
        if (lexed.view(star) != "*") continue;
        std::string out = pointee(file, before_start(lexed, star) + 1, star, manner);
        if (!out.empty()) return out;
    }
    return {};
}

}  // namespace porttool

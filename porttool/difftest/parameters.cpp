// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/parameters.h"

#include "porttool/difftest/argument_list.h"
#include "porttool/difftest/old_style.h"

namespace porttool {
namespace {

/// Takes in some tokens of a declaration. `is_text`: strings, and what is behind `void*`, are drawn by nobody.
void read_declaration(const ScannedFile& file, TokenRange range, const CppManner& manner, bool& is_text,
                      SubjectParameter& out) {
    const LexedText& lexed = file.lexed;
    for (uint32_t i = range.first; i < range.end; ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "=") break;
        if (word == "[") {
            uint32_t close = i;
            while (close < range.end && lexed.view(close) != "]") ++close;
            out.bound = cpp_text_of(file, {i + 1, close}, manner);
            out.is_pointer = out.bound.empty();
            out.can_be_array = out.is_pointer && !is_text;
            break;
        }
        if (word == "*") {
            out.can_be_array = !out.is_pointer && !is_text;
            out.is_pointer = true;
        }
        out.is_reference = out.is_reference || word == "&";
        const bool is_byte =
            word == "char" && i > range.first && (lexed.view(i - 1) == "unsigned" || lexed.view(i - 1) == "signed");
        out.is_file = out.is_file || word == "FILE";
        out.is_untyped = out.is_untyped || word == "void";
        is_text = is_text || (word == "char" && !is_byte) || word == "void" || word == "FILE";
        if (lexed.tokens[i].kind == TokenKind::Identifier) out.name = word;
    }
}

}  // namespace

std::vector<SubjectParameter> parameters_of(const ScannedFile& file, const Unit& unit, const CppManner& manner) {
    std::vector<SubjectParameter> out;
    const auto add = [&](std::initializer_list<TokenRange> ranges) {
        bool is_text = false;
        out.emplace_back();
        for (const TokenRange range : ranges) read_declaration(file, range, manner, is_text, out.back());
    };
    if (is_old_style(file.lexed, unit)) {
        for (const OldStyleParameter& one : old_style_parameters(file.lexed, unit)) add({one.type, one.name});
        return out;
    }
    const TokenRange newer = newer_list(file.lexed, unit);
    for (const TokenRange part : list_parts(file.lexed, newer.empty() ? unit.parameters : newer))
        if (part.end != part.first + 1 || file.lexed.view(part.first) != "void") add({part});
    return out;
}

}  // namespace porttool

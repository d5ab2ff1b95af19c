// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/parameters.h"

#include "porttool/difftest/argument_list.h"

namespace porttool {
namespace {

SubjectParameter parameter_of(const ScannedFile& file, TokenRange range, const CppManner& manner) {
    const LexedText& lexed = file.lexed;
    SubjectParameter out;
    bool is_text = false;  // strings, and what is behind `void*`, are drawn by nobody
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
        is_text = is_text || word == "char" || word == "void" || word == "FILE";
        if (lexed.tokens[i].kind == TokenKind::Identifier) out.name = word;
    }
    return out;
}

}  // namespace

std::vector<SubjectParameter> parameters_of(const ScannedFile& file, const Unit& unit, const CppManner& manner) {
    std::vector<SubjectParameter> out;
    for (const TokenRange part : list_parts(file.lexed, unit.parameters))
        if (part.end != part.first + 1 || file.lexed.view(part.first) != "void")
            out.push_back(parameter_of(file, part, manner));
    return out;
}

}  // namespace porttool

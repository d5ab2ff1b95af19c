// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/template_values.h"

#include <algorithm>

#include "porttool/difftest/argument_list.h"

namespace porttool {
namespace {

/// True for a body that does with its numbers what can be done to whole ones alone.
bool shifts(const Definition& function) {
    const LexedText& lexed = function.file->lexed;
    for (uint32_t i = function.unit->body.first; i < function.unit->body.end; ++i) {
        const std::string_view word = lexed.view(i);
        for (const char* one : {">>", "<<", "%", "|", "^", ">>=", "<<=", "%=", "|=", "&=", "^="})
            if (word == one) return true;
        // Two that close lists of a template are read one by one, and so is a shift.
        if (word == ">" && i + 2 < function.unit->body.end && lexed.view(i + 1) == ">" &&
            lexed.tokens[i + 1].offset == lexed.tokens[i].offset + 1 &&
            (lexed.tokens[i + 2].kind == TokenKind::Number || lexed.view(i + 2) == "("))
            return true;
    }
    return false;
}

/// True for the type of a value that a template can be made for.
bool is_whole_type(std::string_view word) {
    return word == "int" || word == "unsigned" || word == "size_t" || word == "uint" || word == "uint32_t" ||
           word == "int32_t" || word == "long" || word == "short";
}

}  // namespace

std::string number_type_of(const Definition& function) {
    const LexedText& lexed = function.file->lexed;
    std::string whole;
    for (uint32_t i = function.unit->parameters.first; i < function.unit->parameters.end; ++i) {
        const std::string_view word = lexed.view(i);
        const auto is_of = [&](std::string_view name) {
            return word.starts_with(name) && word.size() <= name.size() + 1;  // float4
        };
        for (const char* name : {"float", "double", "half", "vec", "real"})
            if (is_of(name)) return "float";
        for (const char* name : {"uint", "unsigned", "uvec", "uint32_t"})
            if (is_of(name)) whole = "unsigned int";
        for (const char* name : {"int", "ivec", "int32_t", "size_t"})
            if (whole.empty() && is_of(name)) whole = "int";
    }
    return whole.empty() && shifts(function) ? "unsigned int" : whole.empty() ? "float" : whole;
}

std::string template_arguments(const ScannedFile& file, const Unit& unit, const std::string& type) {
    const LexedText& lexed = file.lexed;
    if (lexed.view(unit.tokens.first) != "template" || lexed.view(unit.tokens.first + 1) != "<") return {};
    std::string out;
    uint32_t i = unit.tokens.first + 2;
    for (int depth = 1; i < unit.name_token; ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "<") ++depth;
        if (word == ">" && --depth == 0) break;
        if (depth > 1) return "?";
    }
    for (const TokenRange part : list_parts(lexed, {unit.tokens.first + 2, i})) {
        uint32_t first = part.first;
        while (first < part.end && lexed.view(first) == "const") ++first;
        const std::string_view word = lexed.view(first);
        constexpr const char* kValue = "4";  // as wide as vectors are, and a power of two
        const std::string argument = word == "class" || word == "typename" ? type
                                     : word == "bool"                      ? "true"
                                     : is_whole_type(word)                 ? kValue
                                                                           : "";
        if (argument.empty()) return "?";
        out += (out.empty() ? "<" : ", ") + argument;
    }
    return out.empty() ? out : out + ">";
}

std::map<std::string, std::string> template_values(const ScannedFile& file, const Unit& unit,
                                                   const std::string& arguments) {
    std::map<std::string, std::string> out;
    if (arguments.empty()) return out;
    const LexedText& lexed = file.lexed;
    uint32_t end = unit.tokens.first + 2;
    while (end < unit.name_token && lexed.view(end) != ">") ++end;
    size_t at = 1;
    for (const TokenRange part : list_parts(lexed, {unit.tokens.first + 2, end})) {
        const size_t next = std::min(arguments.find_first_of(",>", at), arguments.size());
        std::string_view name;
        for (uint32_t i = part.first; i < part.end && lexed.view(i) != "="; ++i)
            if (lexed.tokens[i].kind == TokenKind::Identifier) name = lexed.view(i);
        out.emplace(name, arguments.substr(at, next - at));
        at = std::min(next + 2, arguments.size());
    }
    return out;
}

std::pair<std::string, std::string> template_head(const Definition& one, const CppManner& manner) {
    const LexedText& lexed = one.file->lexed;
    uint32_t i = one.tokens.first;
    if (lexed.view(i) != "template") return {};
    const uint32_t first = i;
    int depth = 0;
    for (++i; i < one.tokens.end; ++i) {
        if (lexed.view(i) == "<") ++depth;
        if (lexed.view(i) == ">" && --depth == 0) break;
    }
    std::string arguments;
    for (const TokenRange part : list_parts(lexed, {first + 2, i})) {
        std::string_view name;
        for (uint32_t at = part.first; at < part.end && lexed.view(at) != "="; ++at)
            if (lexed.tokens[at].kind == TokenKind::Identifier) name = lexed.view(at);
        arguments += (arguments.empty() ? "" : ", ") + std::string(name);
    }
    return {cpp_text_of(*one.file, {first + 2, i}, manner), "<" + arguments + ">"};
}

}  // namespace porttool

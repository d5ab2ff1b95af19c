// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/struct_visitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "porttool/compare/struct_fields.h"
#include "porttool/difftest/argument_list.h"
#include "porttool/difftest/template_values.h"
#include "porttool/language/words.h"
#include "porttool/normal/unit_state.h"

namespace porttool {

std::vector<std::string> bases_of(const Definition& one) {
    const LexedText& lexed = one.file->lexed;
    std::vector<std::string> out;
    bool listed = false;
    int depth = 0, rounds = 0;
    for (uint32_t i = one.tokens.first; i < one.tokens.end && lexed.view(i) != "{" && lexed.view(i) != ";"; ++i) {
        if (lexed.view(i) == "(") ++rounds;
        if (lexed.view(i) == ")") --rounds;
        if (lexed.view(i) == ":" && rounds == 0) listed = true;
        if (!listed) continue;
        if (lexed.view(i) == "<") ++depth;
        if (lexed.view(i) == ">") --depth;
        const bool ends = lexed.view(i + 1) == "{" || lexed.view(i + 1) == ",";
        if (depth == 0 && ends && lexed.tokens[i].kind == TokenKind::Identifier) out.emplace_back(lexed.view(i));
    }
    return out;
}

std::vector<std::string> fields_of(const Definition& one) {
    std::vector<std::string> out;
    if (one.unit == nullptr) return out;
    const UnitState state = unit_state(*one.file, *one.unit);
    const Words words = data_fields(state.text.words());
    auto at = std::find(words.begin(), words.end(), "{");
    std::string name;
    bool named = false, starts = true;
    int depth = 0;
    for (at = at == words.end() ? at : at + 1; at != words.end(); ++at) {
        // #ifdef NAME, #endif: where a field stands under a condition, it is one.
        if (*at == "#" && at + 2 < words.end()) {
            at += *(at + 1) == "ifdef" || *(at + 1) == "ifndef" ? 2 : 1;
            continue;
        }
        if (*at == "{") ++depth;
        if (*at == "}" && depth-- == 0) break;
        if (*at == ";" && depth == 0) {
            if (!name.empty()) out.push_back(name);
            name.clear();
            named = false;
            starts = true;
            continue;
        }
        if (depth > 0) continue;
        // int (*less)(const void* a, const void* b);
        if (*at == "(" && !named && at + 2 < words.end() && *(at + 1) == "*" && is_word_token(*(at + 2))) {
            name = *(at + 2);
            named = true;
        }
        // `using value_type = T;` and `static constexpr int n = 4;` are no fields.
        if (std::exchange(starts, false) && (*at == "using" || *at == "typedef" || *at == "static")) {
            at = std::find(at, words.end(), ";");
            if (at == words.end()) break;
            starts = true;
            continue;
        }
        if (*at == "[" || *at == "=" || *at == ":") named = true;
        if (!named && is_word_token(*at)) name = *at;
    }
    return out;
}

namespace {

/// A struct or union within another one, which has no name of a type.
struct NestedPart {
    std::string name;                 ///< of the member; "" for none, or what a macro may make none
    std::vector<std::string> fields;  ///< that stand directly in it
    bool is_union = false;
};

/// Written in capitals, as macros are.
bool may_be_macro(std::string_view name) {
    return name.size() > 2 && std::none_of(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

/// The parts whose fields are reached without a name, or by one that a macro may make none.
std::vector<NestedPart> nested_parts(const Definition& one) {
    std::vector<NestedPart> out;
    const LexedText& lexed = one.file->lexed;
    std::vector<std::string_view> words;
    for (uint32_t i = one.tokens.first; i < one.tokens.end; ++i)
        if ((lexed.tokens[i].flags & (kDead | kInDirective)) == 0) words.push_back(lexed.view(i));
    const auto first = std::find(words.begin(), words.end(), "{");
    NestedPart part;
    std::string last;
    bool named = false;
    int depth = 0;
    for (auto at = first == words.end() ? first : first + 1; at != words.end(); ++at) {
        if (*at == "{" && depth++ == 0) {
            part = {};
            part.is_union = *(at - 1) == "union";
            last = part.is_union || *(at - 1) == "struct" ? "" : "?";  // a type with a name, or a list of values
            if (!last.empty()) part.name = "?";
            continue;
        }
        if (*at == "}" && --depth < 0) break;
        if (*at == "}" && depth == 0) {
            const bool has_name = at + 2 < words.end() && is_word_token(*(at + 1)) && *(at + 2) == ";";
            const bool has_none = at + 1 < words.end() && *(at + 1) == ";";
            if (part.name.empty() && !part.fields.empty() && (has_none || (has_name && may_be_macro(*(at + 1))))) {
                part.name = has_name ? std::string(*(at + 1)) : std::string();
                out.push_back(part);
            }
        }
        if (depth != 1) {
            named = depth > 1;  // what a part within the part is called does not count
            last.clear();
            continue;
        }
        if (*at == ";") {
            if (!last.empty() && !named) part.fields.push_back(last);
            last.clear();
            named = false;
        } else if (*at == "[" || *at == "=" || *at == ":" || *at == "(") {
            if (!last.empty() && !named) part.fields.push_back(last);
            named = true;
        } else if (!named && is_word_token(*at)) {
            last = *at;
        }
    }
    return out;
}

}  // namespace

std::string announced(const Definition& one, const CppManner& manner) {
    const LexedText& lexed = one.file->lexed;
    for (uint32_t i = one.tokens.first; i < one.tokens.end && lexed.view(i) != "{"; ++i) {
        if (lexed.view(i) == "typedef") return {};
        if (lexed.view(i) != one.name) continue;
        const std::string head = template_head(one, manner).first;
        return (head.empty() ? "" : "template <" + head + "> ") + "struct " + one.name + ";\n";
    }
    return {};
}

std::string visitor(const Definition& one, const CppManner& manner, const std::set<std::string, std::less<>>& words) {
    const auto [head, arguments] = template_head(one, manner);
    std::string out = fmt::format("template <{}{}class porttool_V> void porttool_visit({}{}& x, porttool_V& v) {{\n",
                                  head, head.empty() ? "" : ", ", one.name, arguments);
    for (const std::string& base : bases_of(one))
        out += fmt::format("porttool_harness::walk(v, \"\", static_cast<{}&>(x));\n", base);
    std::set<std::string> through_parts;
    for (const NestedPart& part : nested_parts(one)) {
        through_parts.insert(part.name);
        const size_t from = part.is_union ? part.fields.size() - 1 : 0;  // one of those that lie in one place
        for (size_t i = from; i < part.fields.size(); ++i)
            out += fmt::format("porttool_harness::walk_unnamed(v, \"{0}\", PORTTOOL_MEMBER(x, {1}).{0});\n",
                               part.fields[i], part.name);
    }
    for (const std::string& field : fields_of(one))
        if (!through_parts.contains(field))
            out += fmt::format("porttool_harness::{1}(v, \"{0}\", x.{0}{2});\n", field,
                               words.contains(field) ? "walk" : "walk_unnamed",
                               is_name_in_c(field, one.file->language) ? "_" : "");
    return out + "}\n";
}

}  // namespace porttool

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
    for (const std::string& field : fields_of(one))
        out += fmt::format("porttool_harness::{1}(v, \"{0}\", x.{0}{2});\n", field,
                           words.contains(field) ? "walk" : "walk_unnamed",
                           is_name_in_c(field, one.file->language) ? "_" : "");
    return out + "}\n";
}

}  // namespace porttool

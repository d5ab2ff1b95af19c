// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/struct_fields.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "porttool/compare/brackets.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

/// True for the bracket of `ALIGNED ( 16 ) float3 v`.
bool is_macro_before_field(const Words& statement, size_t open) {
    if (open != 1) return false;
    const size_t after = after_parentheses(statement, open);
    return after + 1 < statement.size() && is_word_token(statement[after]) &&
           !is_one_of(statement[after], {"const", "volatile", "noexcept", "override", "final", "throw"});
}

/// The name that a statement without data gives to a type, which fields may use: `typedef float T`, `using T = float`;
/// "" for others.
std::string_view named_for_fields(const Words& statement) {
    const auto assigned = std::find(statement.begin(), statement.end(), "=");
    if (statement[0] == "using") return assigned == statement.begin() + 2 ? statement[1] : std::string_view();
    if (statement[0] == "typedef")
        for (auto at = statement.rbegin(); at != statement.rend(); ++at)
            if (is_word_token(*at)) return *at;
    return {};
}

/// True for a statement in a struct that declares a function, calls a macro, or names something without data.
bool holds_no_data(const Words& statement) {
    if (is_one_of(statement[0], {"friend", "using", "typedef", "static_assert", "template", "static", "explicit",
                                 "virtual", "operator", "~"}))
        return true;
    int depth = 0;
    for (size_t i = 0; i < statement.size(); ++i) {
        const std::string_view word = statement[i];
        if (word == "operator") return true;
        if (word == "=" || word == "{") return false;
        const bool own_list = i > 0 && (word_is(statement[i - 1], kTakesArguments) || statement[i - 1] == "defined");
        if (word == "(" && depth == 0 && i + 1 < statement.size() && statement[i + 1] == "*")
            return false;  // to a function
        if (word == "(" && depth == 0 && !own_list && !is_macro_before_field(statement, i)) return true;
        if (word == "(" || word == "[" || word == "<") ++depth;
        if ((word == ")" || word == "]" || word == ">") && depth > 0) --depth;
    }
    return false;
}

}  // namespace

Words data_fields(const Words& tokens) {
    const auto open = std::find(tokens.begin(), tokens.end(), "{");
    if (open == tokens.end()) return tokens;
    Words out(tokens.begin(), open + 1), statement;
    std::vector<std::pair<size_t, Words>> named;  // what may be used by fields, and where it stood
    int depth = 0;
    for (auto at = open + 1; at != tokens.end(); ++at) {
        const bool ends = depth == 0 && (*at == ";" || *at == "}");
        if (depth == 0 && *at == ":" && statement.size() == 1 && word_is(statement[0], kLabel)) {
            statement.clear();
            continue;
        }
        if (!ends) {
            if (*at == "{") ++depth;
            if (*at == "}") --depth;
            statement.push_back(*at);
            continue;
        }
        if (!statement.empty() && !holds_no_data(statement)) {
            out.insert(out.end(), statement.begin(), statement.end());
            out.emplace_back(";");
        } else if (!statement.empty() && !named_for_fields(statement).empty()) {
            named.emplace_back(out.size(), statement);
        }
        statement.clear();
        if (*at != "}") continue;
        out.insert(out.end(), at, tokens.end());
        break;
    }
    const std::unordered_set<std::string_view> used(out.begin(), out.end());
    for (auto last = named.rbegin(); last != named.rend(); ++last) {
        Words& words = last->second;
        if (!used.contains(named_for_fields(words))) continue;
        words.emplace_back(";");
        out.insert(out.begin() + static_cast<std::ptrdiff_t>(last->first), words.begin(), words.end());
    }
    return single_fields(out);
}

Words single_fields(const Words& tokens) {
    Words out;
    auto at = std::find(tokens.begin(), tokens.end(), "{");
    out.assign(tokens.begin(), at == tokens.end() ? at : at + 1);
    Words field;
    const auto flush = [&] {
        size_t name = field.size(), depth = 0;
        std::vector<size_t> commas;
        for (size_t i = 0; i < field.size(); ++i) {
            if (field[i] == "(" || field[i] == "[" || field[i] == "<") ++depth;
            if ((field[i] == ")" || field[i] == "]" || field[i] == ">") && depth > 0) --depth;
            if (depth == 0 && field[i] == ",") commas.push_back(i);
        }
        const size_t first_end = commas.empty() ? field.size() : commas[0];
        for (size_t i = 0; i < first_end && name == field.size(); ++i)
            if (i + 1 == first_end || field[i + 1] == "[" || field[i + 1] == "=" || field[i + 1] == ":") name = i;
        commas.push_back(field.size());
        out.insert(out.end(), field.begin(), field.begin() + static_cast<std::ptrdiff_t>(first_end));
        for (size_t c = 0; c + 1 < commas.size(); ++c) {
            out.emplace_back(";");
            out.insert(out.end(), field.begin(), field.begin() + static_cast<std::ptrdiff_t>(name));
            out.insert(out.end(), field.begin() + static_cast<std::ptrdiff_t>(commas[c]) + 1,
                       field.begin() + static_cast<std::ptrdiff_t>(commas[c + 1]));
        }
        field.clear();
    };
    for (at = at == tokens.end() ? at : at + 1; at != tokens.end(); ++at) {
        if (*at == ";" || *at == "{" || *at == "}") {
            flush();
            out.push_back(*at);
            continue;
        }
        if (*at == "int" && !field.empty() && (field.back() == "unsigned" || field.back() == "signed")) {
            field.back() = field.back() == "unsigned" ? "uint" : "int";
            continue;
        }
        field.push_back(*at);
    }
    flush();
    return out;
}

}  // namespace porttool

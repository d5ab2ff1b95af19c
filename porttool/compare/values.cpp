// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/values.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "porttool/compare/constant_expression.h"
#include "porttool/compare/struct_fields.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

/// The tokens of a constant's value: after the first `=`, from the first `{`, or after a macro's name. Empty for a
/// macro with parameters.
Words value_words(const Words& tokens) {
    auto first = tokens.begin();
    auto end = tokens.end();
    if (tokens.size() > 3 && tokens[0] == "#")
        first += 3;
    else
        first = std::find_if(first, end, [](const auto& t) { return t == "=" || t == "{"; });
    if (first != end && *first == "=") ++first;
    while (first < end && *(end - 1) == ";") --end;
    Words out;
    for (; first != end; ++first) {
        const bool second = !out.empty() && (*first == "<" || *first == ">") && out.back() == *first;
        if (second)
            out.back() = *first == "<" ? "<<" : ">>";  // normal form has shifts as two tokens
        else
            out.push_back(*first);
    }
    return out;
}

/// The declared type of a constant, which converts its value: `const float A = 1`.
NumberType declared_type(const Words& tokens, const Dialect& dialect) {
    if (!tokens.empty() && tokens[0] == "#") return NumberType::None;
    NumberType out = NumberType::None;
    for (const std::string_view word : tokens) {
        if (word == "=" || word == "{") break;
        if (word == "[") return NumberType::Many;
        if (out == NumberType::None || number_type(word, dialect) == NumberType::Unsigned)
            out = number_type(word, dialect) == NumberType::None ? out : number_type(word, dialect);
        if (word == "auto") out = NumberType::None;
    }
    return out;
}

std::string shown(const Words& words) {
    std::string out;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string_view before = i > 0 ? words[i - 1] : "(", previous = i > 1 ? words[i - 2] : "(";
        const auto opens = [](std::string_view w) { return w == "(" || w == "[" || w == "{"; };
        const auto is_sign = [](std::string_view w) { return w == "-" || w == "+" || w == "~"; };
        const bool after_sign =
            is_sign(before) && (opens(previous) || previous == "," || previous.find_first_of("+-*/%<>&|^") == 0);
        const bool tight = i == 0 || opens(before) || words[i] == ")" || words[i] == "]" || words[i] == "}" ||
                           words[i] == "," || words[i] == ";" || words[i] == "[" || after_sign ||
                           (words[i] == "(" && (std::isalpha(static_cast<unsigned char>(before[0])) || before == "]"));
        out += tight ? "" : " ";
        out += words[i];
    }
    return out;
}

/// What both sides have, in a sentence; of long texts the part from where they differ.
std::string both_shown(const char* what, Words left, Words right) {
    constexpr size_t kLongest = 80, kBefore = 4;
    size_t same = 0;
    const size_t least = std::min(left.size(), right.size());
    while (same < least && left[same] == right[same]) ++same;
    const bool is_long = std::max(shown(left).size(), shown(right).size()) > kLongest;
    const size_t first = is_long && same > kBefore ? std::min(same, least) - kBefore : 0;
    const auto quoted = [&](Words& words) {
        words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(first));
        std::string text = shown(words);
        if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
        return (first > 0 ? "'... " : "'") + text + "'";
    };
    return what + quoted(left) + " in the source and " + quoted(right) + " in the port";
}

/// The value of a constant or the fields of a struct in common words.
std::string value_in_common_words(const Words& tokens, const Dialect& dialect, bool is_struct) {
    Words value;
    auto first = tokens.begin();
    if (is_struct) {
        first = std::find(tokens.begin(), tokens.end(), "{");
    } else {
        // after the first `=` or `{`, or after a macro's name
        first = std::find_if(tokens.begin(), tokens.end(), [](const auto& t) { return t == "=" || t == "{"; });
        if (tokens.size() > 2 && tokens[0] == "#") first = tokens.begin() + 2;
    }
    if (first != tokens.end()) value.assign(first + 1, tokens.end());
    std::string out;
    for (const Statement& statement : split_statements(value, dialect)) out += statement.key + ";";
    return out;
}

ComparedValues compare_structs(const Words& left, const Words& right, const Dialect& dialect) {
    ComparedValues out;
    const Words left_fields = data_fields(left), right_fields = data_fields(right);
    out.same = value_in_common_words(left_fields, dialect, true) == value_in_common_words(right_fields, dialect, true);
    const auto plain = [](const Words& words) {  // nothing but fields: no functions, bases or access words
        return std::find_if(words.begin(), words.end(),
                            [](const auto& w) { return w == "(" || w == ":" || w == "<" || w == "#"; }) == words.end();
    };
    out.certain = plain(left_fields) && plain(right_fields);
    const auto body = [](const Words& words) {
        auto first = std::find(words.begin(), words.end(), "{");
        auto end = words.end();
        if (first != end) ++first;
        while (first < end && (*(end - 1) == ";" || *(end - 1) == "}")) --end;
        return Words(first, end);
    };
    out.says = both_shown("the fields are ", body(left_fields), body(right_fields));
    return out;
}

/// The names between the braces of a list, without the values that some are given; empty if it is none of names.
std::set<std::string> listed_names(const Words& tokens) {
    std::set<std::string> out;
    auto at = std::find(tokens.begin(), tokens.end(), "{");
    for (bool begins = true; at != tokens.end() && *at != "}"; ++at) {
        if (*at == "{" || *at == ",") {
            begins = true;
        } else if (std::exchange(begins, false)) {
            if (!is_word_token(*at)) return {};
            out.emplace(*at);
        }
    }
    return out;
}

}  // namespace

bool list_draws_nearer(const Words& before, const Words& now, const Words& other) {
    const std::set<std::string> then = listed_names(before), today = listed_names(now), there = listed_names(other);
    if (then.empty() || there.empty() || then == there || then == today) return false;
    const bool adds = std::includes(today.begin(), today.end(), then.begin(), then.end());
    if (!adds && !std::includes(then.begin(), then.end(), today.begin(), today.end())) return false;
    const std::set<std::string>&more = adds ? today : then, &less = adds ? then : today;
    return std::all_of(more.begin(), more.end(),
                       [&](const std::string& name) { return less.contains(name) || there.contains(name) == adds; });
}

ComparedValues compare_values(UnitKind kind, const Words& left, const Words& right, const Dialect& dialect) {
    if (kind == UnitKind::Struct) return compare_structs(left, right, dialect);
    const auto value_of = [&](const Words& tokens) {
        Words words = value_words(tokens);
        const NumberType type = declared_type(tokens, dialect);
        if (type == NumberType::Real || type == NumberType::Unsigned || type == NumberType::Int) {
            words.insert(words.begin(), type == NumberType::Real ? "float" : type == NumberType::Int ? "int" : "uint");
            words.insert(words.begin() + 1, "(");
            words.emplace_back(")");
        }
        return evaluate_constant(words, dialect);
    };
    ComparedValues out;
    const std::string a = value_of(left), b = value_of(right);
    out.certain = !a.empty() && !b.empty();
    out.same = out.certain
                   ? a == b
                   : value_in_common_words(left, dialect, false) == value_in_common_words(right, dialect, false);
    Words left_shown = value_words(left), right_shown = value_words(right);
    for (Words* words : {&left_shown, &right_shown})
        if (words->size() == 3 && words->front() == "{") *words = {(*words)[1]};
    out.says = both_shown("the value is ", left_shown, right_shown);
    return out;
}

}  // namespace porttool

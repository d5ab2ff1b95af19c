// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/same_anyway.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "porttool/compare/brackets.h"
#include "porttool/compare/casts.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

std::string_view word_at(const Words& words, size_t i) { return i < words.size() ? words[i] : std::string_view(); }

/// A number's type whose conversion is the same whether it is written or not.
bool is_plain_number_type(std::string_view word) {
    return is_one_of(word, {"int", "uint", "float", "double", "short", "long", "ulong", "size_t", "int8_t", "uint8_t",
                            "int16_t", "uint16_t", "int32_t", "uint32_t", "int64_t", "uint64_t"});
}

/// Behind the bracket that closes the one at `open`, or the end.
size_t behind_bracket(const Words& words, size_t open) {
    int depth = 0;
    for (size_t i = open; i < words.size(); ++i) {
        if (is_one_of(words[i], {"(", "[", "{"})) ++depth;
        if (is_one_of(words[i], {")", "]", "}"}) && --depth == 0) return i + 1;
    }
    return words.size();
}

/// The brackets of the parameters: of `@ (`; both 0 where there is none.
struct ParameterList {
    size_t open = 0, end = 0;

    explicit ParameterList(const Words& words) {
        const auto name = std::find(words.begin(), words.end(), "@");
        const auto at = static_cast<size_t>(name - words.begin()) + 1;
        if (name == words.end() || word_at(words, at) != "(") return;
        open = at;
        end = behind_bracket(words, at);
    }
};

/// One parameter, `const float & k` or `float const & k`, as `float k`.
Words handed_over_by_value(const Words& one) {
    Words out = one;
    const auto sign = std::find(out.begin(), out.end(), "&");
    if (sign == out.end() || std::count(out.begin(), out.end(), "&") != 1 || sign + 1 == out.end() ||
        !is_word_token(*(sign + 1)) || (sign + 2 != out.end() && *(sign + 2) != "="))
        return one;
    const bool leads = out.front() == "const", follows = sign != out.begin() && *(sign - 1) == "const";
    if (leads == follows || std::count(out.begin(), sign, "const") != 1 ||
        std::any_of(out.begin(), sign, [](std::string_view word) {
            return is_one_of(word, {"*", "(", "["});
        }))
        return one;
    out.erase(sign);
    out.erase(std::find(out.begin(), out.end(), "const"));
    return out;
}

/// The parameters between the brackets, each as handed_over_by_value() has it.
Words parameters_by_value(const Words& words, const ParameterList& where) {
    Words out, one;
    int depth = 0;
    for (size_t i = where.open + 1; i + 1 < where.end; ++i) {
        if (is_one_of(words[i], {"(", "[", "{", "<"})) ++depth;
        if (is_one_of(words[i], {")", "]", "}", ">"})) --depth;
        if (words[i] != "," || depth != 0) {
            one.push_back(words[i]);
            continue;
        }
        for (const std::string_view word : handed_over_by_value(one)) out.push_back(word);
        out.push_back(words[i]);
        one.clear();
    }
    for (const std::string_view word : handed_over_by_value(one)) out.push_back(word);
    return out;
}

/// The types of the numbers that a text declares as names of its own, each once: `float x = 0`, `int n )`.
std::map<std::string_view, std::string_view> types_of_numbers(const Words& words) {
    std::map<std::string_view, std::string_view> out;
    for (size_t i = 0; i + 2 < words.size(); ++i) {
        if (!is_word_token(words[i]) || !is_word_token(words[i + 1]) || words[i] == "return") continue;
        if (!is_one_of(words[i + 2], {"=", ";", ",", ")"})) continue;
        const bool is_member = i > 0 && is_one_of(words[i - 1], {".", "->", "::"});
        const bool is_number = is_plain_number_type(words[i]) && !is_member;
        const auto [known, is_new] = out.emplace(words[i + 1], is_number ? words[i] : std::string_view());
        if (!is_new) known->second = {};
    }
    return out;
}

/// Behind a value at `i` that a cast in front of it takes whole: a name with its members, elements and calls, a number,
/// or what stands in parentheses; `i` where more than that stands before the `;`.
size_t behind_lone_value(const Words& words, size_t i) {
    const size_t first = i;
    if (word_at(words, i) == "(") {
        i = behind_bracket(words, i);
    } else {
        if (!is_word_token(word_at(words, i)) && !is_number_token(word_at(words, i))) return first;
        ++i;
    }
    while (i < words.size() && words[i] != ";") {
        if (is_one_of(words[i], {"(", "["}))
            i = behind_bracket(words, i);
        else if (is_one_of(words[i], {".", "->", "::"}) && is_word_token(word_at(words, i + 1)))
            i += 2;
        else
            return first;
    }
    return word_at(words, i) == ";" ? i : first;
}

/// What stands at `i` up to a `;` without a cast to `type` around all of it, or nothing.
Words without_cast_to(const Words& words, size_t i, std::string_view type) {
    const auto copy = [&](size_t first, size_t end) {
        return Words(words.begin() + static_cast<std::ptrdiff_t>(first),
                     words.begin() + static_cast<std::ptrdiff_t>(end));
    };
    if (word_at(words, i) == "(" && word_at(words, i + 1) == type && word_at(words, i + 2) == ")") {
        const size_t end = behind_lone_value(words, i + 3);
        if (end == i + 3) return {};
        const bool in_brackets = words[i + 3] == "(" && behind_bracket(words, i + 3) == end;
        return in_brackets ? copy(i + 4, end - 1) : copy(i + 3, end);
    }
    const bool is_static = word_at(words, i) == "static_cast" && word_at(words, i + 1) == "<" &&
                           word_at(words, i + 2) == type && word_at(words, i + 3) == ">";
    const size_t open = is_static ? i + 4 : word_at(words, i) == type ? i + 1 : 0;
    if (open == 0 || word_at(words, open) != "(") return {};
    const size_t end = behind_bracket(words, open);
    if (word_at(words, end) != ";" || end == open + 2) return {};
    const Words value = copy(open + 1, end - 1);
    return std::find(value.begin(), value.end(), ",") == value.end() ? value : Words();
}

/// True if a text may hold a lambda, whose type is what it returns.
bool has_lambda(const Words& words) {
    for (size_t i = 0; i + 1 < words.size(); ++i)
        if (words[i] == "]" && is_one_of(words[i + 1], {"(", "{"})) return true;
    return false;
}

bool is_condition_operator(std::string_view word) {
    return is_one_of(word, {"&&", "||", ">=", "<=", "==", "!=", ">", "<", "+", "*", "%", "/"});
}

/// Behind the condition that begins at `i`, or `i` where its words ask for something else than versions.
size_t behind_version_condition(const Words& words, size_t i) {
    const size_t first = i;
    int depth = 0;
    bool any = false, wants_operand = true;
    for (; i < words.size(); ++i) {
        const std::string_view word = words[i];
        if (wants_operand && is_one_of(word, {"(", "!"})) {
            depth += word == "(" ? 1 : 0;
        } else if (wants_operand && word == "defined") {
            const bool in_brackets = word_at(words, i + 1) == "(";
            if (!tells_a_version(word_at(words, i + (in_brackets ? 2 : 1)))) return first;
            i += in_brackets ? 3 : 1;
            any = true;
            wants_operand = false;
        } else if (wants_operand) {
            if (!is_number_token(word) && !tells_a_version(word)) return first;
            any = any || tells_a_version(word);
            wants_operand = false;
        } else if (word == ")" && depth > 0) {
            --depth;
        } else if (is_condition_operator(word) && !(word == "*" && depth == 0)) {
            wants_operand = true;
        } else {
            break;
        }
    }
    return any && depth == 0 && !wants_operand ? i : first;
}

}  // namespace

bool tells_a_version(std::string_view macro) {
    if (std::any_of(macro.begin(), macro.end(), [](char c) { return c >= 'a' && c <= 'z'; })) return false;
    if (is_one_of(macro, {"__CUDA_ARCH__", "__CUDACC__", "__HIPCC__", "__cplusplus", "__GNUC__", "__GNUC_MINOR__",
                          "_MSC_VER", "__CUDACC_VER_MAJOR__", "__CUDACC_VER_MINOR__", "__INTEL_COMPILER"}))
        return true;
    const size_t at = macro.find("VERSION");
    return at != std::string_view::npos && at > 0 && macro[at - 1] == '_';
}

Words with_values_as_taken(const Words& tokens) {
    const Words words = with_one_word_types(tokens);
    const ParameterList where(words);
    Words plain;
    if (where.end > 0) {
        plain.assign(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(where.open) + 1);
        for (const std::string_view word : parameters_by_value(words, where)) plain.push_back(word);
        plain.insert(plain.end(), words.begin() + static_cast<std::ptrdiff_t>(where.end) - 1, words.end());
    } else {
        plain = words;
    }
    const auto types = types_of_numbers(plain);
    const auto name = std::find(plain.begin(), plain.end(), "@");
    const bool knows_result = name != plain.end() && name != plain.begin() && !has_lambda(plain);
    const std::string_view result = knows_result ? *(name - 1) : std::string_view();
    Words out;
    for (size_t i = 0; i < plain.size(); ++i) {
        out.push_back(plain[i]);
        std::string_view type;
        if (plain[i] == "return" && is_plain_number_type(result)) type = result;
        const bool starts = i < 2 || is_one_of(plain[i - 2], {";", "{", "}"});
        if (plain[i] == "=" && i > 1 && (starts || is_plain_number_type(plain[i - 2])))
            if (const auto known = types.find(plain[i - 1]); known != types.end()) type = known->second;
        if (type.empty()) continue;
        const Words value = without_cast_to(plain, i + 1, type);
        if (value.empty()) continue;
        out.insert(out.end(), value.begin(), value.end());
        while (i + 1 < plain.size() && plain[i + 1] != ";") ++i;
    }
    return out;
}

Words with_one_version_condition(const Words& tokens) {
    Words out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        out.push_back(tokens[i]);
        const bool asks = i > 0 && tokens[i - 1] == "#" && is_one_of(tokens[i], {"if", "elif"});
        const size_t end = asks ? behind_version_condition(tokens, i + 1) : i + 1;
        if (end == i + 1) continue;
        out.emplace_back("_VERSION");
        i = end - 1;
    }
    return out;
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/plain_statement.h"

#include <algorithm>

#include "porttool/compare/casts.h"
#include "porttool/compare/phrases.h"
#include "porttool/compare/plain_updates.h"
#include "porttool/language/spelling.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

std::string_view at(const Words& words, size_t i) { return i < words.size() ? words[i] : std::string_view(); }

/// After the bracket that closes the one at `open`; the end if none of the next `most` words does.
template <class List>
size_t after_bracket(const List& words, size_t open, size_t most) {
    int depth = 0;
    for (size_t i = open; i < words.size() && i - open < most; ++i) {
        if (words[i] == "(" || words[i] == "[" || words[i] == "{") ++depth;
        if ((words[i] == ")" || words[i] == "]" || words[i] == "}") && --depth == 0) return i + 1;
    }
    return words.size();
}

/// After the brackets of an attribute, or the end. A bracket may open at every word, so what is looked through is
/// bounded.
size_t after_attribute(const Words& words, size_t open) {
    constexpr size_t kLongest = 256;
    return after_bracket(words, open, kLongest);
}

/// True if every attribute between `first` and `end` changes no value, whatever its arguments and scope.
bool all_idle(const Words& words, size_t first, size_t end) {
    bool any = false;
    for (size_t i = first; i < end;) {
        if (words[i] == ",") {
            ++i;
            continue;
        }
        if (at(words, i + 1) == "::") {
            i += 2;
            continue;
        }
        std::string_view name = words[i];
        while (name.starts_with("_")) name.remove_prefix(1);
        while (name.ends_with("_")) name.remove_suffix(1);
        if (!word_is(name, kIdleAttribute)) return false;
        any = true;
        i = at(words, i + 1) == "(" ? after_attribute(words, i + 1) : i + 1;
    }
    return any;
}

/// Parentheses around the whole of what is returned or assigned go.
void open_whole_value(Text& words) {
    const auto value =
        words.empty() || words[0] == "return" ? words.begin() : std::find(words.begin(), words.end(), "=");
    const auto first = static_cast<size_t>(value - words.begin()) + 1;
    if (first + 2 >= words.size() || words[first] != "(" || after_bracket(words, first, words.size()) != words.size())
        return;
    int depth = 0;
    for (size_t i = first; i < words.size(); ++i) {
        if (words[i] == "(") ++depth;
        if (words[i] == ")") --depth;
        if (depth == 1 && words[i] == ",") return;  // a comma means another thing without them
    }
    words.pop_back();
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(first));
}

/// `void @ :: f (`, whose class is part of its name, is `void @ (`: that the name is another one is told by itself.
void drop_class_of_name(Text& head) {
    const auto name = static_cast<size_t>(std::find(head.begin(), head.end(), "@") - head.begin());
    size_t end = name + 1;
    while (end + 1 < head.size() && head[end] == "::" && is_word_token(head[end + 1])) end += 2;
    if (end < head.size() && head[end] == "(")
        head.erase(head.begin() + static_cast<std::ptrdiff_t>(name) + 1,
                   head.begin() + static_cast<std::ptrdiff_t>(end));
}

/// `auto @ ( float x ) -> float` as `float @ ( float x )`.
void write_type_first(Text& head) {
    const auto name = std::find(head.begin(), head.end(), "@");
    const auto type = std::find(head.begin(), name, "auto");
    const auto arrow = std::find(name, head.end(), "->");
    if (type == name || name == head.end() || arrow + 1 >= head.end() || *(arrow - 1) != ")") return;
    const Text said(arrow + 1, head.end());
    head.erase(arrow, head.end());
    head.insert(head.erase(head.begin() + (type - head.begin())), said.begin(), said.end());
}

/// A head with the words that say what kind of function it is, and its bounds of a launch, in one order: before its
/// type they may stand in any.
///
///     __launch_bounds__ ( 128 ) __global__ void f (        __global__ __launch_bounds__ ( 128 ) void f (
///     [ [ kernel ] ] void f (                              kernel void f (
void write_manner_first(Text& head, Language language) {
    const bool is_attribute = head.size() > 5 && head[0] == "[" && head[1] == "[" && head[3] == "]" && head[4] == "]";
    if (language == Language::Metal && is_attribute && is_one_of(head[2], {"kernel", "vertex", "fragment"})) {
        head.erase(head.begin() + 3, head.begin() + 5);
        head.erase(head.begin(), head.begin() + 2);
    }
    const auto name = std::find(head.begin(), head.end(), "@");
    const auto bounds = std::find(head.begin(), name, "__launch_bounds__");
    if (bounds == name || bounds + 1 == name || *(bounds + 1) != "(") return;
    const auto first = static_cast<size_t>(bounds - head.begin());
    const size_t end = after_bracket(head, first + 1, head.size());
    if (end >= static_cast<size_t>(name - head.begin()) + 1) return;
    std::rotate(head.begin(), bounds, head.begin() + static_cast<std::ptrdiff_t>(end));
}

/// `layout ( local_size_x = 8 , local_size_y = 1 ) in` without the sizes that are 1, as those are that are not given.
void drop_default_sizes(Text& words) {
    if (words.size() < 8 || words[0] != "layout" || words[1] != "(" || words.back() != "in") return;
    for (size_t i = 2; i + 3 < words.size();) {
        const bool is_default = words[i].starts_with("local_size_") && !words[i].ends_with("_id") &&
                                words[i + 1] == "=" && words[i + 2] == "1";
        const bool has_next = is_default && words[i + 3] == ",";
        const bool has_last = is_default && i > 2 && words[i - 1] == "," && words[i + 3] == ")";
        if (!has_next && !has_last) {
            ++i;
            continue;
        }
        const auto first = words.begin() + static_cast<std::ptrdiff_t>(has_next ? i : i - 1);
        words.erase(first, first + 4);
        if (has_last) return;
    }
}

/// The type of a literal that `auto` takes from it; "" for one with another suffix, or too large for an `int`.
std::string_view type_of_literal(std::string_view literal) {
    constexpr size_t kSurelyInt = 9;  // digits
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    if (std::all_of(literal.begin(), literal.end(), is_digit)) return literal.size() <= kSurelyInt ? "int" : "";
    if (literal.starts_with("0x")) return "";
    const bool is_float = literal.ends_with('f');
    if (is_float) literal.remove_suffix(1);
    const bool is_real = std::all_of(literal.begin(), literal.end(), [&](char c) {
        return is_digit(c) || is_one_of(std::string_view(&c, 1), {".", "e"});
    });
    if (!is_real) return "";
    return is_float ? "float" : "double";
}

/// `auto i = 0` as `int i = 0`, also in the head of a loop.
void write_types_of_literals(Text& words) {
    for (size_t i = 0; i + 3 < words.size(); ++i) {
        const bool is_alone = i + 4 == words.size() || words[i + 4] == ";";
        if (words[i] != "auto" || !is_word_token(words[i + 1]) || words[i + 2] != "=" || !is_alone ||
            !is_number_token(words[i + 3]))
            continue;
        if (const std::string_view type = type_of_literal(words[i + 3]); !type.empty()) words[i] = type;
    }
}

/// `const_cast<T&>(x)` as `x`: what may be written is no matter of values.
void drop_const_casts(Text& words) {
    for (size_t i = 0; i + 3 < words.size(); ++i) {
        if (words[i] != "const_cast" || words[i + 1] != "<") continue;
        size_t open = i + 2;
        while (open < words.size() && words[open] != "(" && words[open] != ";") ++open;
        if (open >= words.size() || words[open] != "(" || words[open - 1] != ">") continue;
        const size_t end = after_bracket(words, open, words.size());
        const bool is_name =
            end == open + 3 ||
            std::none_of(words.begin() + static_cast<std::ptrdiff_t>(open) + 1,
                         words.begin() + static_cast<std::ptrdiff_t>(end) - 1, [](const std::string& word) {
                             return !is_word_token(word) && word != "." && word != "->" && word != "::";
                         });
        if (!is_name) continue;
        words.erase(words.begin() + static_cast<std::ptrdiff_t>(end) - 1);
        words.erase(words.begin() + static_cast<std::ptrdiff_t>(i),
                    words.begin() + static_cast<std::ptrdiff_t>(open) + 1);
    }
}

}  // namespace

/// After what stands at `i` and changes no value, or `i`.
size_t PlainStatements::after_idle(const Words& words, size_t i, bool in_head) const {
    const std::string_view word = words[i];
    if (word_is(word, kPromise)) return i + 1;
    if (is_one_of(word, {"__attribute__", "__attribute", "__declspec"}) && at(words, i + 1) == "(") {
        const size_t end = after_attribute(words, i + 1);
        const size_t inner = at(words, i + 2) == "(" ? 1 : 0;
        return all_idle(words, i + 2 + inner, end - 1 - inner) ? end : i;
    }
    if (word == "[" && at(words, i + 1) == "[") {
        const size_t end = after_attribute(words, i);
        return end >= i + 4 && all_idle(words, i + 2, end - 2) ? end : i;
    }
    if (word == "[" && i == 0) {
        const size_t end = after_attribute(words, i);
        return all_idle(words, 1, end - 1) ? end : i;
    }
    const bool names_type = is_one_of(word, {"struct", "class", "enum", "union"}) && i + 2 < words.size() &&
                            is_word_token(words[i + 1]) && words[i + 2] != ":" && words[i + 2] != "{";
    if (names_type || (word == "class" && i > 0 && is_one_of(words[i - 1], {"<", ","}))) return i + 1;
    if (word == "std" && at(words, i + 1) == "::" && has_other_spellings(at(words, i + 2))) return i + 2;
    if (!in_head) return i;
    if (word == "extern" && at(words, i + 1).starts_with("\"")) return i + 2;
    if (word == "noexcept" && at(words, i + 1) == "(" && at(words, i + 2) != "false")
        return after_attribute(words, i + 1);
    if (word_is(word, kHeadPromise) || (names_inlining(word) && at(words, i + 1) != "(")) return i + 1;
    if (language_ == Language::Ispc && word == "noinline") return i + 1;
    const size_t first = i > 0 && words[i - 1] == "const" ? i - 1 : i;
    const bool starts_parameter =
        first > 0 && is_one_of(words[first - 1], {"(", ","}) && is_word_token(at(words, i + 1));
    const bool in_is_default = traits_of(language_).literals == Literals::Shading;
    return word == "in" && starts_parameter && in_is_default ? i + 1 : i;
}

std::string PlainStatements::spelled(std::string_view word) const {
    if (is_number_token(word)) {
        std::string number = normal_number(word);
        if (language_ != Language::Glsl || !number.ends_with('f') || word.starts_with("0x")) return number;
        number.pop_back();
        return number.find_first_of(".en") != std::string::npos ? number : number + ".0";
    }
    return std::string(one_spelling(word, language_));
}

std::vector<std::string> PlainStatements::translate(const Words& statement, bool in_body) const {
    Words words;
    const bool in_head = is_code_ && !in_body;
    const bool thrown_away = is_code_ && in_body && at(statement, 0) == "(" && at(statement, 1) == "void" &&
                             at(statement, 2) == ")" && is_word_token(at(statement, 3));
    for (size_t i = thrown_away ? 3 : 0; i < statement.size();) {
        const size_t end = is_code_ ? after_idle(statement, i, in_head) : i;
        if (end == i) words.push_back(statement[i++]);
        i = std::max(i, end);
    }
    Text out;
    for (const std::string_view word : with_one_word_types(words)) out.push_back(spelled(word));
    vectors_.write_plain(out);
    if (!is_code_) return out;
    if (in_head && out.size() > 3 && out[out.size() - 1] == ")" && out[out.size() - 2] == "void" &&
        out[out.size() - 3] == "(")
        out.erase(out.end() - 2);  // f(void)
    if (in_head) write_type_first(out);
    if (in_head) write_manner_first(out, language_);
    if (in_head) drop_class_of_name(out);
    if (language_ == Language::Glsl) drop_default_sizes(out);
    out = with_plain_launches(with_functional_casts(with_c_casts(out, dialect_), dialect_));
    out = with_plain_global_ids(out, dialect_);
    write_types_of_literals(out);
    drop_const_casts(out);
    open_whole_value(out);
    drop_status_check(out);
    drop_cast_to_declared_type(out);
    write_steps_first(out);
    return out;
}

}  // namespace porttool

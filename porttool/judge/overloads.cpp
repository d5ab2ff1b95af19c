// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/overloads.h"

#include <algorithm>
#include <set>

#include "porttool/language/words.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// Where the parameters of a function's text open, behind `@`, `@ < float >` or, of an operator, `@ + =`; nothing where
/// it has none.
std::optional<size_t> list_of(const NormalText& text, bool is_call_operator) {
    constexpr size_t kMostWords = 64;
    size_t at = 0;
    while (at < text.size() && text[at] != "@") ++at;
    const size_t end = std::min(text.size(), at + kMostWords);
    while (at < end && text[at] != "(") ++at;
    if (is_call_operator) at += 2;  // `@ ( ) ( float x )`
    return at < end && text[at] == "(" ? std::optional(at) : std::nullopt;
}

bool is_left_out(std::string_view word) {
    return word == "const" || word == "volatile" || word == "&" || word == "&&" || word == "__restrict__" ||
           word == "restrict" || word == "struct" || word == "in";
}

/// `float`, `unsigned int`: what converts into each other by itself.
bool is_number(const std::string& type) {
    static const std::set<std::string_view> kNumbers = {
        "bool",     "char",   "short",   "int",     "long",    "unsigned", "signed",   "float",
        "double",   "half",   "__half",  "size_t",  "uint",    "uint8_t",  "uint16_t", "uint32_t",
        "uint64_t", "int8_t", "int16_t", "int32_t", "int64_t", "ptrdiff_t"};
    size_t at = 0;
    bool any = false;
    while (at < type.size()) {
        const size_t end = std::min(type.find(' ', at), type.size());
        if (!kNumbers.contains(std::string_view(type).substr(at, end - at))) return false;
        any = true;
        at = end + 1;
    }
    return any;
}

/// The type of a parameter: all but what is left out, its name and its default.
std::string type_of(std::vector<std::string_view> words) {
    if (const auto value = std::find(words.begin(), words.end(), "="); value != words.end())
        words.erase(value, words.end());
    std::erase_if(words, is_left_out);
    if (words.size() > 1 && is_word_token(words.back()) && !is_type_word(words.back()) &&
        words[words.size() - 2] != "::")
        words.pop_back();
    std::string out;
    for (const std::string_view word : words) out.append(out.empty() ? "" : " ").append(word);
    return out;
}

void read_types(const NormalText& text, size_t open, Signature& out) {
    constexpr size_t kMostWords = 256;
    int depth = 0;
    std::vector<std::string_view> words;
    const auto finish = [&] {
        if (!words.empty()) out.types.push_back(type_of(words));
        words.clear();
    };
    for (size_t i = open; i < std::min(text.size(), open + kMostWords); ++i) {
        const std::string_view word = text[i];
        if (word == "(" || word == "[" || word == "{" || word == "<") ++depth;
        if (word == ")" || word == "]" || word == "}" || word == ">") --depth;
        if (depth == 0) break;
        if (depth == 1 && word == ",") {
            finish();
            continue;
        }
        if (i > open) words.push_back(word);
        out.written.append(" ").append(word);
        out.takes_anything = out.takes_anything || word == "..." || word == "auto" || (depth == 1 && word == "=");
    }
    finish();
}

}  // namespace

Signature signature_of(const UnitState& unit) {
    Signature out;
    const std::string_view leaf = bare_leaf_of(unit.name);
    const size_t scope = unit.name.rfind("::");
    out.leaf = leaf;
    out.scope = scope == std::string::npos ? std::string() : unit.name.substr(0, scope + 2);
    out.is_function = unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel;
    const NormalText& text = unit.text.get();
    if (!out.is_function) {  // `template < > struct @ < float >`
        for (size_t i = 0; i < text.size() && i < 64 && text[i] != "{" && text[i] != ";" && text[i] != "="; ++i)
            if (text[i] == "<" || text[i] == ">" || !out.types.empty()) out.types.emplace_back(text[i]);
        return out;
    }
    if (!text.empty() && text[0] == "template") out.written = text[0];
    out.takes_anything = !text.empty() && text[0] == "template" && text.size() > 2 && text[2] != ">";
    constexpr std::string_view kOperator = "operator";
    const std::string_view sign = leaf.starts_with(kOperator) ? leaf.substr(kOperator.size()) : std::string_view();
    if (const std::optional<size_t> open = list_of(text, out.leaf == "operator()")) read_types(text, *open, out);
    // An operator within a class takes the object as well.
    if (!sign.empty() && sign[0] != ' ' && !is_word_token(sign) && out.types.size() < 2 && !out.scope.empty())
        out.types.insert(out.types.begin(), std::string(leaf_of(std::string_view(unit.name).substr(0, scope))));
    return out;
}

bool compete(const Signature& a, const Signature& b) {
    if (a.takes_anything || b.takes_anything) return true;
    return std::equal(a.types.begin(), a.types.end(), b.types.begin(), b.types.end(),
                      [](const std::string& one, const std::string& other) {
                          return one == other || (is_number(one) && is_number(other));
                      });
}

std::optional<size_t> parts_of_list(const NormalText& text, size_t open) {
    constexpr size_t kMostWords = 256;
    const size_t end = std::min(text.size(), open + kMostWords);
    size_t parts = 0;
    bool is_empty = true;
    int depth = 0;
    for (size_t i = open; i < end; ++i) {
        const std::string_view word = text[i];
        if (word == ")" || word == "]" || word == "}") {
            if (--depth == 0) return is_empty ? 0 : parts + 1;
        } else if (i > open) {
            is_empty = false;
        }
        if (word == "(" || word == "[" || word == "{") ++depth;
        if (depth == 1 && word == ",") ++parts;
        if (depth == 1 && (word == "..." || word == "=" || word == "<")) return std::nullopt;
    }
    return std::nullopt;
}

bool may_take(const UnitState& unit, const NormalText& text, size_t call) {
    size_t head = 0;
    while (head < unit.text.size() && unit.text[head] != "@") ++head;
    if (unit.kind == UnitKind::Constant || head + 1 >= unit.text.size() || unit.text[head + 1] != "(") return true;
    const std::optional<size_t> takes = parts_of_list(unit.text, head + 1), given = parts_of_list(text, call);
    return !takes || !given || *takes == *given;
}

}  // namespace porttool

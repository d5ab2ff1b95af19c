// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/scopes.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/directive_end.h"
#include "porttool/normal/normal_text.h"

namespace porttool {
namespace {

bool is_plain_name(std::string_view word) {
    return is_word_token(word) && !is_type_word(word) && !word_is(word, kKeyword | kQualifier | kTypePart);
}

/// True for a variable that bears the name of another language's type: `int half = n / 2 ;`.
bool is_type_of_others(const std::vector<std::string>& words, size_t i) {
    return words[i + 1] == "=" && is_type_word(words[i]) && !word_is(words[i], kKeyword | kQualifier | kTypePart) &&
           is_type_word(words[i - 1]);
}

bool may_declare(const std::vector<std::string>& words, size_t i) {
    return i > 0 && i + 1 < words.size() && (is_plain_name(words[i]) || is_type_of_others(words, i)) &&
           is_one_of(words[i + 1], {"=", ";", "[", ",", ")", "(", ":", "{"});
}

/// True for a name after a type.
bool declares(const std::vector<std::string>& words, size_t i) {
    if (!may_declare(words, i) || words[i + 1] == "(" || words[i + 1] == ":") return false;
    const std::string& last = words[i - 1];
    return is_type_word(last) || (is_word_token(last) && !word_is(last, kKeyword | kQualifier));
}

/// The same, or what may be one: further names of a declaration, pointers, arrays. True if nothing but names and what
/// types are made of stands between the beginning of the statement, or of a parameter list, and the name.
bool may_bring(const std::vector<std::string>& words, size_t i) {
    if (!may_declare(words, i)) return false;
    if (!is_one_of(words[i - 1], {"*", "&", ">", ",", "]"}) && !is_word_token(words[i - 1])) return false;
    constexpr size_t kFarthest = 200;
    bool with_values = false;  // `int i = 0 , k = 1`
    for (size_t k = i; k > 0 && i - k < kFarthest;) {
        const std::string& word = words[--k];
        if (word == "=" && words[i - 1] == ",") with_values = true;
        if (with_values && is_one_of(word, {";", "{", "}", "("})) {
            const bool head = word == "(";
            return (!head || (k > 0 && words[k - 1] == "for")) && declares(words, k + 2);
        }
        if (is_one_of(word, {";", "{", "}"})) return true;
        if (words[i - 1] == "," && (with_values || word == "=" || is_number_token(word))) continue;
        const bool to_array = word == "(" && words[k + 1] == "*" && k > 0 && is_word_token(words[k - 1]);
        if (to_array) continue;  // `float ( * rows ) [ 4 ]`
        if (word == "(") return k > 0 && (is_one_of(words[k - 1], {"@", "for", "]"}));
        if (word_is(word, kKeyword) && !is_type_word(word) && !word_is(word, kQualifier | kTypePart)) return false;
        const bool part =
            is_word_token(word) || is_number_token(word) || is_one_of(word, {"*", "&", "::", "<", ">", ",", "[", "]"});
        if (!part) return false;
    }
    return true;
}

/// True for a name of `auto [ a , b ] = f ( ) ;`.
bool is_bound(const std::vector<std::string>& words, size_t i) {
    if (!is_plain_name(words[i])) return false;
    size_t open = i;
    while (open > 0 && (is_word_token(words[open]) || words[open] == ",")) --open;
    if (words[open] != "[" || open == 0) return false;
    while (open > 1 && is_one_of(words[open - 1], {"&", "&&"})) --open;
    return words[open - 1] == "auto";
}

bool is_member(const std::vector<std::string>& words, size_t i) {
    return i > 0 && is_one_of(words[i - 1], {".", "->", "::"});
}

/// The values that a template takes: `kSize` of `template < typename T , int kSize >`.
std::set<std::string> template_values(const std::vector<std::string>& words) {
    std::set<std::string> out;
    if (words.size() < 2 || words[0] != "template" || words[1] != "<") return out;
    int depth = 1;
    for (size_t i = 2; i + 1 < words.size() && depth > 0; ++i) {
        const bool ends = depth == 1 && is_one_of(words[i + 1], {",", "=", ">"});
        if (ends && is_plain_name(words[i]) && is_type_word(words[i - 1])) out.insert(words[i]);
        depth += words[i] == "<" ? 1 : words[i] == ">" ? -1 : 0;
    }
    return out;
}

/// The parameters of a function's head, however they are handed over: the last name of each. A method's name may go on
/// behind its `@`: `void @ < T > :: scale (`.
std::set<std::string> parameter_names(const std::vector<std::string>& words) {
    std::set<std::string> out = template_values(words);
    auto at = static_cast<size_t>(std::find(words.begin(), words.end(), "@") - words.begin());
    while (at < words.size() && words[at] != "(") ++at;
    int depth = 1;
    for (++at; at < words.size(); ++at) {
        const std::string& word = words[at];
        depth += is_one_of(word, {"(", "[", "<"}) ? 1 : is_one_of(word, {")", "]", ">"}) ? -1 : 0;
        if (word == ">>" && depth > 2) depth -= 2;
        const bool ends = (depth == 1 && is_one_of(word, {",", "="})) || (depth == 2 && word == "[") || depth == 0;
        const std::string &name = words[at - 1], &last = words[at - 2];
        const bool typed = is_word_token(last) || is_one_of(last, {"*", "&", ">"});
        if (ends && is_plain_name(name) && typed) out.insert(name);
        if (depth == 0) break;
    }
    return out;
}

std::set<std::string> declared_names(const std::vector<std::string>& words) {
    std::set<std::string> out = parameter_names(words);
    for (size_t i = 0; i < words.size(); ++i)
        if ((declares(words, i) && !is_member(words, i)) || is_bound(words, i)) out.insert(words[i]);
    return out;
}

/// Those of `declared` that are used where no block around declares them.
std::set<std::string> used_out_of_scope(const std::vector<std::string>& words, const std::set<std::string>& declared) {
    std::set<std::string> out;
    const std::set<std::string> parameters = parameter_names(words);
    std::vector<std::set<std::string_view>> blocks{{parameters.begin(), parameters.end()}};
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "{") blocks.emplace_back();
        if (words[i] == "}" && blocks.size() > 1) blocks.pop_back();
        if (!declared.contains(words[i]) || is_member(words, i)) continue;
        if (may_bring(words, i) || declares(words, i) || is_bound(words, i)) {
            blocks.back().insert(words[i]);
            continue;
        }
        const bool reached =
            std::any_of(blocks.begin(), blocks.end(), [&](const auto& block) { return block.contains(words[i]); });
        if (!reached) out.insert(words[i]);
    }
    return out;
}

/// Names that a block declares more than once, but for heads of loops and parameters.
std::set<std::string> declared_twice_in_a_block(const std::vector<std::string>& words) {
    std::set<std::string> out;
    std::vector<std::set<std::string_view>> blocks(1);
    std::vector<int> depths{0};  // of parentheses, in each block
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "{") blocks.emplace_back(), depths.push_back(0);
        if (words[i] == "}" && blocks.size() > 1) blocks.pop_back(), depths.pop_back();
        depths.back() += words[i] == "(" ? 1 : words[i] == ")" ? -1 : 0;
        if (depths.back() > 0 || blocks.size() < 2 || is_member(words, i) || !may_bring(words, i)) continue;
        if (words[i - 1] == ",") continue;  // it may be an argument of a template
        if (!blocks.back().insert(words[i]).second) out.insert(words[i]);
    }
    return out;
}

}  // namespace

std::set<std::string> names_doubled(const std::vector<std::string>& before, const std::vector<std::string>& now) {
    const std::set<std::string> known = declared_twice_in_a_block(before);
    std::set<std::string> out = declared_twice_in_a_block(now);
    std::erase_if(out, [&](const std::string& name) { return known.contains(name); });
    return out;
}

std::set<std::string> lost_names(const std::vector<std::string>& before, const std::vector<std::string>& now) {
    std::set<std::string> out, brought = parameter_names(now);
    const std::set<std::string> declared = declared_names(before);
    for (size_t i = 0; i < now.size(); ++i) {
        if (may_bring(now, i) || declares(now, i) || is_bound(now, i)) brought.insert(now[i]);
        if (declared.contains(now[i]) && !is_member(now, i)) out.insert(now[i]);
    }
    std::erase_if(out, [&](const std::string& name) { return brought.contains(name); });
    // What was used without a declaration before is a parameter of a macro, or comes from elsewhere.
    std::set<std::string> all = declared_names(now);
    all.insert(declared.begin(), declared.end());
    const std::set<std::string> known = used_out_of_scope(before, all);
    for (const std::string& name : used_out_of_scope(now, all))
        if (!known.contains(name)) out.insert(name);
    return out;
}

std::set<std::string, std::less<>> declared_pointers(const std::vector<std::string>& words) {
    const auto head_end = static_cast<size_t>(std::find(words.begin(), words.end(), "{") - words.begin());
    std::set<std::string, std::less<>> out;
    const std::set<std::string> parameters = parameter_names(words);
    std::map<std::string, size_t> times;
    for (size_t i = 2; i + 1 < words.size(); ++i) {
        const bool is_parameter = i < head_end && parameters.contains(words[i]) && is_one_of(words[i + 1], {",", ")"});
        if (!is_parameter && (i < head_end || !may_bring(words, i))) continue;
        ++times[words[i]];
        size_t star = i - 1;
        while (star > 1 && word_is(words[star], kQualifier)) --star;
        const bool one = words[star] == "*" && star > 0 && words[star - 1] != "*" && is_word_token(words[star - 1]);
        if (one && words[i + 1] != "[") out.insert(words[i]);
    }
    std::erase_if(out, [&](const std::string& name) { return times[name] != 1; });
    return out;
}

Words without_directives(const std::vector<std::string>& words) {
    Words out(words.begin(), words.end());
    for (size_t i = 0; i < out.size(); ++i) {
        if (out[i] != "#") continue;
        const size_t end = std::max(i + 1, directive_end(Words(words.begin(), words.end()), i));
        std::fill(out.begin() + static_cast<std::ptrdiff_t>(i), out.begin() + static_cast<std::ptrdiff_t>(end), ";");
    }
    return out;
}

std::vector<std::pair<size_t, size_t>> declared_behind_macro(const Words& words) {
    std::vector<std::pair<size_t, size_t>> out;
    for (size_t i = 3; i + 1 < words.size(); ++i) {
        if (!is_plain_name(words[i]) || !is_one_of(words[i + 1], {"=", ";", "["})) continue;
        size_t type = i - 1;
        while (type > 2 && words[type] == "*") --type;
        if (type < 2) continue;
        const std::string_view macro = words[type - 1], before = words[type - 2];
        const bool begins =
            is_one_of(before, {";", "{", "}"}) || (before == "(" && type > 2 && words[type - 3] == "for");
        const bool is_type = is_type_word(words[type]) || is_plain_name(words[type]);
        if (begins && is_word_token(macro) && is_shouted(macro) && is_type) out.emplace_back(type - 1, i);
    }
    return out;
}

std::set<std::string> names_out_of_scope(const std::vector<std::string>& words) {
    return used_out_of_scope(words, declared_names(words));
}

}  // namespace porttool

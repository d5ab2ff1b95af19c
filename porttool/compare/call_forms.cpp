// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/call_forms.h"

#include <algorithm>
#include <cstddef>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

bool is_access(std::string_view word) { return word == "." || word == "->"; }

constexpr size_t kLongestValue = 64;  // words, of a value

/// Where the brackets open that close with the last of [0, end); `end` if they do not soon.
size_t opening_before(const Text& words, size_t end) {
    int depth = 0;
    for (size_t i = end; i > 0 && end - i < kLongestValue; --i) {
        const std::string& word = words[i - 1];
        if (word == ")" || word == "]") ++depth;
        if ((word == "(" || word == "[") && --depth == 0) return i - 1;
    }
    return end;
}

/// Where the value begins that ends with the last of `words`: `a . b [ i ]`, `f ( x )`; their number if it is none.
size_t value_before(const Text& words) {
    size_t first = words.size();
    while (first > 0 && words.size() - first < kLongestValue) {
        const size_t end = first;
        while (first > 0 && (words[first - 1] == ")" || words[first - 1] == "]")) {
            const size_t open = opening_before(words, first);
            if (open == first) return words.size();
            first = open;
        }
        const bool named = first > 0 && is_word_token(words[first - 1]) && words[first - 1] != "return";
        if (named) --first;
        if (first == end) return words.size();
        if (first == 0 || !(is_access(words[first - 1]) || words[first - 1] == "::")) return first;
        if (!named) return words.size();
        --first;
    }
    return words.size();
}

/// The only name of some, or "".
std::string only_name(const std::map<std::string, std::set<std::string>>& names, const std::string& small_name) {
    const auto found = names.find(small_name);
    return found == names.end() || found->second.size() != 1 ? std::string() : *found->second.begin();
}

/// `isblack` of `Color_IsBlack`; "" for a name without a type.
std::string without_type(std::string_view name) {
    const size_t underscore = name.find('_');
    const bool of_type = underscore != std::string_view::npos && name[0] >= 'A' && name[0] <= 'Z';
    return of_type ? in_small_letters(name.substr(underscore + 1)) : std::string();
}

/// True before the name of a function that is declared: a type.
bool is_declared(std::string_view before) {
    return is_word_token(before) && before != "return" && before != "else" && before != "case";
}

/// Where the first argument ends of the call whose bracket is at `open`; `open` if it has none, or a long one.
size_t first_argument_end(const Text& words, size_t open) {
    int depth = 0;
    for (size_t i = open + 1; i < words.size() && i < open + kLongestValue; ++i) {
        const std::string& word = words[i];
        if (depth == 0 && (word == "," || word == ")")) return i == open + 1 ? open : i;
        if (word == "(" || word == "[" || word == "{") ++depth;
        if (word == ")" || word == "]" || word == "}") --depth;
    }
    return open;
}

void insert_made(Reworded& out, size_t at, std::initializer_list<const char*> words) {
    out.words.insert(out.words.begin() + static_cast<std::ptrdiff_t>(at), words.begin(), words.end());
    out.from.insert(out.from.begin() + static_cast<std::ptrdiff_t>(at), words.size(), Reworded::kMade);
}

void erase_words(Reworded& out, size_t at, size_t count) {
    const auto first = static_cast<std::ptrdiff_t>(at), end = static_cast<std::ptrdiff_t>(at + count);
    out.words.erase(out.words.begin() + first, out.words.begin() + end);
    out.from.erase(out.from.begin() + first, out.from.begin() + end);
}

/// Makes the call of a function at `at` one of a method of its first argument.
void make_method_call(Reworded& out, size_t at, const std::string& method) {
    const size_t end = first_argument_end(out.words, at + 1);
    if (end == at + 1) return;
    const bool goes_on = out.words[end] == ",";
    Text argument(out.words.begin() + static_cast<std::ptrdiff_t>(at) + 2,
                  out.words.begin() + static_cast<std::ptrdiff_t>(end));
    const bool whole = value_before(argument) == 0;
    if (goes_on) erase_words(out, end, 1);
    insert_made(out, end, {".", method.c_str(), "("});
    if (!whole) insert_made(out, end, {")"});
    erase_words(out, at, whole ? 2 : 1);
    if (!whole) out.from[at] = Reworded::kMade;
    out.any = true;
}

}  // namespace

void CalledForms::add(const Words& text) {
    for (size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i + 1] != "(" || !is_word_token(text[i])) continue;
        const std::string name(text[i]);
        if (i > 0 && is_access(text[i - 1])) {
            methods_[in_small_letters(name)].insert(name);
            continue;
        }
        functions_[in_small_letters(name)].insert(name);
        if (const std::string plain = without_type(name); !plain.empty()) functions_[plain].insert(name);
    }
}

std::string CalledForms::function_for(const std::string& name) const {
    return methods_.contains(in_small_letters(name)) ? std::string() : only_name(functions_, in_small_letters(name));
}

std::string CalledForms::method_for(const std::string& name) const {
    if (functions_.contains(in_small_letters(name))) return {};
    const std::string found = only_name(methods_, in_small_letters(name)), plain = without_type(name);
    return found.empty() && !plain.empty() ? only_name(methods_, plain) : found;
}

Reworded with_functions_for_methods(const Words& text, const CalledForms& there) {
    Reworded out;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool method = is_access(text[i]) && i + 3 < text.size() && text[i + 2] == "(";
        const std::string function = method ? there.function_for(std::string(text[i + 1])) : std::string();
        const size_t first = function.empty() ? out.words.size() : value_before(out.words);
        if (first == out.words.size()) {
            out.words.emplace_back(text[i]);
            out.from.push_back(i);
            continue;
        }
        const bool in_brackets = out.words[first] == "(" && opening_before(out.words, out.words.size()) == first;
        if (in_brackets) {  // ( a * b ) . Length ( ) is length ( a * b )
            erase_words(out, out.words.size() - 1, 1);
            erase_words(out, first, 1);
        }
        insert_made(out, first, {function.c_str(), "("});
        if (text[i + 3] != ")") insert_made(out, out.words.size(), {","});
        out.any = true;
        i += 2;
    }
    return out;
}

Reworded with_methods_for_functions(const Words& text, const CalledForms& there) {
    constexpr size_t kMost = 5000;  // words: each call moves what follows it
    Reworded out;
    for (size_t i = 0; i < text.size(); ++i) {
        out.words.emplace_back(text[i]);
        out.from.push_back(i);
    }
    // From the last to the first: arguments are said in the new form before what takes them.
    for (size_t i = text.size() <= kMost ? text.size() : 0; i-- > 0;) {
        if (i + 1 >= out.words.size() || out.words[i + 1] != "(" || !is_word_token(out.words[i]) ||
            (i > 0 && (is_access(out.words[i - 1]) || out.words[i - 1] == "::" || is_declared(out.words[i - 1]))))
            continue;
        const std::string method = there.method_for(out.words[i]);
        if (!method.empty()) make_method_call(out, i, method);
    }
    return out;
}

}  // namespace porttool

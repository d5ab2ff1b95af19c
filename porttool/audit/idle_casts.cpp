// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/idle_casts.h"

#include <algorithm>
#include <set>
#include <vector>

#include "porttool/language/words.h"
#include "porttool/normal/statements.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

using CastText = std::vector<std::string>;

/// Behind the angle that closes each `<`; the end of the text for all other words. In one walk, whatever the nest.
std::vector<size_t> behind_angles(const CastText& words) {
    std::vector<size_t> out(words.size(), words.size()), open;
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "<") {
            open.push_back(i);
        } else if (words[i] == ">" && !open.empty()) {
            out[open.back()] = i + 1;
            open.pop_back();
        }
    }
    return out;
}

CastText without_static_casts(const CastText& words) {
    CastText out;
    const std::vector<size_t> behind = behind_angles(words);
    for (size_t i = 0; i < words.size(); ++i) {
        const bool casts = folded(words[i]) == "staticcast" && i + 1 < words.size() && words[i + 1] == "<";
        const size_t end = casts ? behind[i + 1] : 0;
        if (casts && end < words.size() && words[end] == "(")
            i = end - 1;
        else
            out.push_back(words[i]);
    }
    return out;
}

/// True for `name ( 3.0 / 2 )`: numbers, and what joins them.
bool takes_numbers(const CastText& words, size_t name) {
    if (name + 2 >= words.size() || !is_word_token(words[name]) || words[name + 1] != "(") return false;
    bool any = false;
    int depth = 1;
    for (size_t i = name + 2; i < words.size(); ++i) {
        depth += words[i] == "(" ? 1 : words[i] == ")" ? -1 : 0;
        if (depth == 0) return any;
        if (!is_number_token(words[i]) && !is_one_of(words[i], {"+", "-", "*", "/", "(", ")"})) return false;
        any = any || is_number_token(words[i]);
    }
    return false;
}

std::set<std::string> names_that_take_numbers(const CastText& a, const CastText& b) {
    std::set<std::string> out, others;
    for (const CastText* text : {&a, &b})
        for (size_t i = 0; i < text->size(); ++i) {
            if (!is_word_token((*text)[i]) || word_is((*text)[i], kKeyword)) continue;
            (takes_numbers(*text, i) ? out : others).insert((*text)[i]);
        }
    std::erase_if(out, [&](const std::string& name) { return others.contains(name); });
    return out;
}

CastText without_name(const CastText& words, const std::string& name) {
    CastText out;
    for (const std::string& word : words)
        if (word != name) out.push_back(word);
    return out;
}

}  // namespace

std::pair<CastText, CastText> without_idle_casts(const CastText& a, const CastText& b) {
    std::pair<CastText, CastText> out{without_static_casts(a), without_static_casts(b)};
    const std::set<std::string> names = names_that_take_numbers(out.first, out.second);
    if (names.size() != 1) return out;
    return {without_name(out.first, *names.begin()), without_name(out.second, *names.begin())};
}

}  // namespace porttool

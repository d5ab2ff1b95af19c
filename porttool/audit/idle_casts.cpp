// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/idle_casts.h"

#include <algorithm>
#include <set>

#include "porttool/language/words.h"
#include "porttool/normal/statements.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

using CastText = std::vector<std::string>;

/// Behind the bracket that closes the one at `first`; the end of the text where none does.
size_t behind_closing(const CastText& words, size_t first, std::string_view opening, std::string_view closing) {
    int depth = 0;
    for (size_t i = first; i < words.size(); ++i) {
        depth += words[i] == opening ? 1 : words[i] == closing ? -1 : 0;
        if (depth == 0) return i + 1;
    }
    return words.size();
}

CastText without_static_casts(const CastText& words) {
    CastText out;
    for (size_t i = 0; i < words.size(); ++i) {
        const bool casts = folded(words[i]) == "staticcast" && i + 1 < words.size() && words[i + 1] == "<";
        const size_t end = casts ? behind_closing(words, i + 1, "<", ">") : 0;
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
    const size_t end = behind_closing(words, name + 1, "(", ")");
    bool any = false;
    for (size_t i = name + 2; i + 1 < end; ++i) {
        if (!is_number_token(words[i]) && !is_one_of(words[i], {"+", "-", "*", "/", "(", ")"})) return false;
        any = any || is_number_token(words[i]);
    }
    return any;
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

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/plain_references.h"

#include <initializer_list>
#include <set>
#include <vector>

#include "porttool/normal/declaration_words.h"
#include "porttool/value_graph/machine.h"

namespace porttool {
namespace {

/// The `&` of a reference to a constant that a declaration makes, `const` standing at `i`; the end for none.
size_t constant_reference(const Words& words, size_t i) {
    constexpr size_t kLongest = 16;
    for (size_t k = i + 1; k + 1 < words.size() && k < i + kLongest; ++k) {
        if (words[k] == "&") return local_of(words[k + 1]) != 0 ? k : words.size();
        const bool of_type = is_word_token(words[k]) || is_number_token(words[k]) || words[k] == "::" ||
                             words[k] == "<" || words[k] == ">" || words[k] == ",";
        if (!of_type) break;
    }
    return words.size();
}

/// Which of a function's parameters, by their order, have one of the marks in their type.
std::vector<bool> parameters_with(const Words& words, std::initializer_list<std::string_view> marks) {
    std::vector<bool> out(1);
    int depth = 0;
    for (const std::string_view word : words) {
        if (word == "{") break;
        depth += word == "(" ? 1 : word == ")" ? -1 : 0;
        if (depth == 1 && word == ",") out.push_back(false);
        if (depth == 1 && is_one_of(word, marks)) out.back() = true;
    }
    return out;
}

std::vector<bool> pointers_of(const Words& words) { return parameters_with(words, {"*", "["}); }

Words in_plain_manner(const Words& words, const std::vector<bool>& pointers_there) {
    Words out;
    std::set<size_t> dropped;
    bool in_head = true, refers = false;
    size_t parameter = 0;
    int depth = 0;
    for (size_t i = 0; i < words.size(); ++i) {
        in_head = in_head && words[i] != "{";
        depth += words[i] == "(" ? 1 : words[i] == ")" ? -1 : 0;
        parameter += in_head && depth == 1 && words[i] == "," ? 1 : 0;
        const bool is_pointer_there = in_head && parameter < pointers_there.size() && pointers_there[parameter];
        if (words[i] == "const" && !is_pointer_there) dropped.insert(constant_reference(words, i));
        const bool first = i > 0 && (words[i - 1] == "(" || words[i - 1] == ",");
        if (in_head && first && (words[i] == "out" || words[i] == "inout")) {
            refers = true;
            continue;
        }
        if (refers && local_of(words[i]) != 0) {
            out.emplace_back("&");
            refers = false;
        }
        if (!dropped.contains(i)) out.push_back(words[i]);
    }
    return out;
}

}  // namespace

BySide<Words> with_plain_references(const BySide<Words>& texts) {
    return {in_plain_manner(texts.source, pointers_of(texts.target)),
            in_plain_manner(texts.target, pointers_of(texts.source))};
}

bool are_handed_alike(const BySide<Words>& plain) {
    const std::vector<bool> here = parameters_with(plain.source, {"*", "[", "&"}),
                            there = parameters_with(plain.target, {"*", "[", "&"});
    return here.size() != there.size() || here == there;
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/declared_parts.h"

#include "porttool/language/words.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// 3 of `vec3`, `float3`.
size_t parts_of_type(std::string_view type) {
    if (type.size() < 4 || type.back() < '2' || type.back() > '4') return 0;
    const std::string_view kind = type.substr(0, type.size() - 1);
    return is_one_of(kind, {"vec", "dvec", "float", "double", "half"}) ? static_cast<size_t>(type.back() - '0') : 0;
}

}  // namespace

DeclaredParts::DeclaredParts(const Words& text) {
    std::set<std::string_view> others;
    for (size_t i = 0; i + 1 < text.size(); ++i) {
        if (!is_word_token(text[i])) continue;
        const size_t name = text[i + 1] == "&" ? i + 2 : i + 1;
        if (name >= text.size() || !is_word_token(text[name])) continue;
        if (const size_t parts = parts_of_type(text[i]); parts > 0) {
            const auto [known, is_new] = vectors.emplace(text[name], parts);
            if (!is_new && known->second != parts) known->second = 0;
        } else if (is_one_of(text[i], {"float", "double", "half", "real_t"})) {
            reals.insert(text[name]);
        } else if (is_type_word(text[i])) {
            others.insert(text[name]);
        }
    }
    for (const std::string_view name : others) {
        reals.erase(name);
        if (const auto known = vectors.find(name); known != vectors.end()) known->second = 0;
    }
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/own_fields.h"

#include <map>
#include <string>

#include "porttool/compare/struct_fields.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

/// How each field is declared, by its name.
using Fields = std::map<std::string, std::string>;

Fields fields_of(const Words& text) {
    const auto as_written = [](const Words& words, bool) {
        return std::vector<std::string>(words.begin(), words.end());
    };
    Fields out;
    for (const Statement& field : split_statements(data_fields(text), as_written)) {
        std::string name;
        for (const std::string& word : field.common) {
            if (word == "[" || word == "=") break;
            if (is_word_token(word)) name = folded(word);
        }
        if (!field.is_brace() && field.head != Statement::kNoHead) out.emplace(name, field.key);
    }
    return out;
}

}  // namespace

bool only_changes_fields_of_its_own(const LoneTexts& texts) {
    const Fields before = fields_of(texts.before), now = fields_of(texts.now), there = fields_of(texts.other);
    size_t stayed = 0, shared = 0, own = 0;
    for (const auto& [name, declared] : before) {
        const auto found = now.find(name);
        if (found != now.end() && found->second != declared) return false;
        const bool both = there.contains(name);
        if (found == now.end() && both) return false;
        own += found == now.end() ? 1 : 0;
        stayed += found != now.end() ? 1 : 0;
        shared += found != now.end() && both ? 1 : 0;
    }
    for (const auto& [name, declared] : now) {
        if (before.contains(name)) continue;
        if (there.contains(name)) return false;
        ++own;
    }
    return own > 0 && 2 * shared < stayed;
}

}  // namespace porttool

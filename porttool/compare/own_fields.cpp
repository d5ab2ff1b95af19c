// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/own_fields.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// A field's name in the common vocabulary, without `m_`.
std::string plain_field(std::string_view name) {
    constexpr std::string_view kMember = "m_";
    return folded(name.starts_with(kMember) ? name.substr(kMember.size()) : name);
}

/// Where a struct's list of bases begins, and the brace behind it; the brace twice if it has none.
std::pair<size_t, size_t> bases_of(const Words& text) {
    size_t open = 0;
    while (open < text.size() && text[open] != "{") ++open;
    size_t first = 0;
    while (first < open && text[first] != ":") ++first;
    return {first, open};
}

using TypedFields = std::vector<std::pair<std::string, std::string>>;

/// Names and types of a struct's fields, in their order.
TypedFields typed_fields(const Words& text) {
    TypedFields out;
    const auto as_written = [](const Words& words, bool) {
        return std::vector<std::string>(words.begin(), words.end());
    };
    for (const Statement& field : split_statements(data_fields(text), as_written)) {
        if (field.is_brace() || field.head == Statement::kNoHead) continue;
        size_t name = field.common.size();
        for (size_t i = 0; i < field.common.size() && field.common[i] != "[" && field.common[i] != "="; ++i)
            if (is_word_token(field.common[i])) name = i;
        std::string type;
        for (size_t i = 0; i < field.common.size(); ++i) type += i == name ? "@ " : field.common[i] + " ";
        out.emplace_back(name < field.common.size() ? plain_field(field.common[name]) : std::string(), std::move(type));
    }
    return out;
}

/// The fields that came, each as "the one before it, its name", with its type; nothing if others changed or went.
std::map<std::string, std::string> only_gained(const TypedFields& before, const TypedFields& now) {
    std::map<std::string, std::string> out;
    size_t k = 0;
    for (size_t i = 0; i < now.size(); ++i) {
        if (k < before.size() && before[k] == now[i])
            ++k;
        else
            out.emplace((i > 0 ? now[i - 1].first : std::string()) + " " + now[i].first, now[i].second);
    }
    return k == before.size() ? out : std::map<std::string, std::string>();
}

}  // namespace

std::string_view only_changes_base(const Words& before, const Words& now) {
    const auto [first_then, open_then] = bases_of(before);
    const auto [first_now, open_now] = bases_of(now);
    const bool had = first_then < open_then, has = first_now < open_now;
    if (had == has) return {};
    const auto at = [](const Words& text, size_t i) { return text.begin() + static_cast<std::ptrdiff_t>(i); };
    if (!std::equal(before.begin(), at(before, first_then), now.begin(), at(now, first_now)) ||
        !std::equal(at(before, open_then), before.end(), at(now, open_now), now.end()))
        return {};
    const Words& text = had ? before : now;
    std::string_view out;
    for (size_t i = had ? first_then : first_now; i < (had ? open_then : open_now) && text[i] != "<"; ++i) {
        if (text[i] == ",") return {};
        if (is_word_token(text[i])) out = text[i];
    }
    return out;
}

bool gain_the_same_fields(const PairTexts& texts) {
    const TypedFields source = typed_fields(texts.source_before), target = typed_fields(texts.target_before);
    const auto here = only_gained(source, typed_fields(texts.source_now)),
               there = only_gained(target, typed_fields(texts.target_now));
    if (here.empty() || here.size() != there.size()) return false;
    const std::map<std::string, std::string> types(target.begin(), target.end());
    std::map<std::pair<std::string, std::string>, size_t> known;
    for (const auto& [name, type] : source)
        if (const auto found = types.find(name); found != types.end()) ++known[{type, found->second}];
    constexpr size_t kLeast = 2;
    return std::equal(here.begin(), here.end(), there.begin(), [&](const auto& a, const auto& b) {
        const auto found = known.find({a.second, b.second});
        return a.first == b.first && (a.second == b.second || (found != known.end() && found->second >= kLeast));
    });
}

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

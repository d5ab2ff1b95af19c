// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/head_manner.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/head_items.h"

namespace porttool {
namespace {

/// The tokens [first, end) as words, with `@` for that at `name`.
HeadWords head_words(const ScannedFile& file, TokenRange range, uint32_t name) {
    HeadWords out;
    out.tokens = range;
    const LexedText& lexed = file.lexed;
    for (uint32_t i = range.first; i < range.end; ++i) {
        const bool is_name = i == name;
        if (is_name) out.name = lexed.view(i);
        out.words.emplace_back(is_name ? "@" : lexed.view(i));
        if (i > range.first) {
            const Token& before = lexed.tokens[i - 1];
            out.text += lexed.tokens[i].offset > before.offset + before.length ? " " : "";
        }
        out.text += is_name ? "@" : std::string(lexed.view(i));
    }
    return out;
}

/// The token after the bracket that closes the one at `open`, at most `end`.
uint32_t after_bracket(const LexedText& lexed, uint32_t open, uint32_t end) {
    const std::string_view opens = lexed.view(open), closes = opens == "(" ? ")" : opens == "[" ? "]" : ">";
    int depth = 0;
    for (uint32_t i = open; i < end; ++i) {
        if (lexed.view(i) == opens) ++depth;
        if (lexed.view(i) == ">>" && closes == ">") depth -= 2;
        if (lexed.view(i) == closes) --depth;
        if (depth <= 0) return i + 1;
    }
    return end;
}

/// The end of what stands before the type of a function: qualifiers of the function, attributes, macros.
uint32_t end_of_marks(const LexedText& lexed, uint32_t first, uint32_t name) {
    uint32_t i = first;
    while (i < name) {
        const std::string_view word = lexed.view(i);
        const bool is_mark = word_is(word, kHeadPromise | kKernel) || word == "extern" ||
                             lexed.tokens[i].kind == TokenKind::String || word == "__host__" ||
                             (is_macro_like(word) && i + 1 < name && lexed.tokens[i + 1].kind == TokenKind::Identifier);
        if (word == "[" || word == "__attribute__" || word == "__declspec") {
            const uint32_t open = word == "[" ? i : i + 1;
            if (open >= name) return first;
            i = after_bracket(lexed, open, name);
        } else if (is_mark) {
            ++i;
        } else {
            break;
        }
    }
    return i;
}

/// The parameters of a function; none where one is more than a type and a name.
std::optional<std::vector<HeadWords>> parameters_of(const ScannedFile& file, const Unit& unit) {
    const LexedText& lexed = file.lexed;
    std::vector<HeadWords> out;
    uint32_t first = unit.parameters.first;
    int depth = 0;
    for (uint32_t i = first; i <= unit.parameters.end; ++i) {
        const bool ends = i == unit.parameters.end || (lexed.view(i) == "," && depth == 0);
        if (!ends) {
            const std::string_view word = lexed.view(i);
            if (word == "(" || word == "=" || word == "...") return std::nullopt;
            depth += word == "<" || word == "[" ? 1 : word == ">" || word == "]" ? -1 : word == ">>" ? -2 : 0;
            continue;
        }
        if (i > first) {
            uint32_t name = i;
            int inner = 0;
            for (uint32_t k = first; k < i; ++k) {
                const std::string_view word = lexed.view(k);
                inner += word == "<" || word == "[" ? 1 : word == ">" || word == "]" ? -1 : word == ">>" ? -2 : 0;
                if (inner == 0 && lexed.tokens[k].kind == TokenKind::Identifier) name = k;
            }
            // The only word of a parameter is its type.
            const bool named = name < i && name > first && !is_type_word(lexed.view(name)) &&
                               !word_is(lexed.view(name), kQualifier | kTypePart);
            const bool is_void = i == first + 1 && lexed.view(first) == "void";
            if (!is_void && !named) return std::nullopt;
            if (!is_void) out.push_back(head_words(file, {first, i}, name));
        }
        first = i + 1;
    }
    return out;
}

std::optional<HeadParts> parts_of_function(const ScannedFile& file, const Unit& unit) {
    const LexedText& lexed = file.lexed;
    HeadParts out;
    uint32_t first = unit.tokens.first;
    if (lexed.view(first) == "template" && first + 1 < unit.name_token && lexed.view(first + 1) == "<") {
        const uint32_t end = after_bracket(lexed, first + 1, unit.name_token);
        out.template_prefix = {first, end};
        first = end;
    }
    const bool plain = unit.name_token > first && lexed.view(unit.name_token - 1) != "::" &&
                       unit.parameters.end + 2 == unit.body.first && unit.parameters.first == unit.name_token + 2;
    if (!plain) return std::nullopt;
    const uint32_t type = end_of_marks(lexed, first, unit.name_token);
    if (type >= unit.name_token) return std::nullopt;
    out.marks = head_words(file, {first, type}, unit.name_token);
    out.type = head_words(file, {type, unit.name_token}, unit.name_token);
    std::optional<std::vector<HeadWords>> parameters = parameters_of(file, unit);
    if (!parameters) return std::nullopt;
    out.parameters = *std::move(parameters);
    return out;
}

/// A declaration of whatever type of its kind: built into the language, or not. That tells nothing where words beside
/// the type say how it is passed.
std::optional<std::vector<std::string>> shape_of(const HeadWords& source) {
    const std::optional<size_t> type = HeadManners::type_word(source.words);
    if (!type) return std::nullopt;
    std::vector<std::string> out = source.words;
    const bool plain = out.size() == 2;
    out.push_back(plain && is_type_word(out[*type]) ? "built in" : "");
    out[*type] = "$";
    return out;
}

bool is_in_record(const ScannedFile& file, const Unit& unit) {
    return std::any_of(file.units.begin(), file.units.end(), [&](const Unit& other) {
        return &other != &unit && other.kind == UnitKind::Struct && other.tokens.first <= unit.tokens.first &&
               unit.tokens.end <= other.tokens.end;
    });
}

}  // namespace

std::optional<HeadParts> read_head_parts(const ScannedFile& file, const Unit& unit) {
    if (is_in_record(file, unit) || unit.name_token >= file.lexed.tokens.size()) return std::nullopt;
    if (unit.kind == UnitKind::Function) return parts_of_function(file, unit);
    if (unit.kind != UnitKind::Constant || unit.name_token <= unit.tokens.first) return std::nullopt;
    HeadParts out;
    out.type = head_words(file, {unit.tokens.first, unit.name_token}, unit.name_token);
    return out;
}

void HeadManners::learn(const ScannedFile& source, const Unit& unit, const ScannedFile& target, const Unit& port) {
    if (unit.kind != port.kind) return;
    const std::optional<HeadParts> here = read_head_parts(source, unit), there = read_head_parts(target, port);
    if (!here || !there) return;
    if (unit.kind == UnitKind::Constant) {
        ++constants_[here->type.words][there->type.text];
        return;
    }
    ++marks_[here->marks.words][there->marks.text];
    ++types_[here->type.words][there->type.text];
    if (here->parameters.size() != there->parameters.size()) return;
    for (size_t i = 0; i < here->parameters.size(); ++i) {
        const HeadWords &one = here->parameters[i], &other = there->parameters[i];
        ++parameters_[one.words][other.text];
        const auto shape = shape_of(one);
        const auto type = type_word(other.words);
        if (!shape || !type) continue;
        const size_t at = other.text.find(other.words[*type]);
        ++shapes_[*shape][other.text.substr(0, at) + "$" + other.text.substr(at + other.words[*type].size())];
    }
}

std::optional<std::string> HeadManners::shape(const HeadWords& source) const {
    const auto shape = shape_of(source);
    const auto found = shape ? shapes_.find(*shape) : shapes_.end();
    return found == shapes_.end() ? std::nullopt : most_of(found->second);
}

std::optional<size_t> HeadManners::type_word(const std::vector<std::string>& words) {
    std::optional<size_t> out;
    for (size_t i = 0; i < words.size() && words[i] != "@"; ++i) {
        if (!is_word_token(words[i])) continue;
        const bool qualifies = word_is(words[i], kQualifier | kDropped) || words[i] == "in" || words[i] == "out" ||
                               words[i] == "inout" || words[i] == "uniform" || words[i] == "varying" ||
                               words[i] == "struct";
        if (qualifies) continue;
        if (out) return std::nullopt;
        out = i;
    }
    return out;
}

std::optional<std::string> HeadManners::most_of(const Texts& texts) {
    size_t all = 0;
    for (const auto& [text, times] : texts) all += times;
    for (const auto& [text, times] : texts)
        if (4 * times >= 3 * all) return text;
    return std::nullopt;
}

std::optional<std::string> HeadManners::usual(const Said& all, const HeadWords& source) {
    const auto found = all.find(source.words);
    return found == all.end() ? std::nullopt : most_of(found->second);
}

std::optional<std::string> HeadManners::any_marks() const {
    Texts all;
    for (const auto& [source, texts] : marks_)
        for (const auto& [text, times] : texts) all[text] += times;
    return most_of(all);
}

}  // namespace porttool

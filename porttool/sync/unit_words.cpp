// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/unit_words.h"

#include <algorithm>
#include <utility>

#include "porttool/language/language.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/prelude.h"

namespace porttool {
namespace {

bool is_blank_line(const LexedText& lexed, uint32_t line) {
    const size_t first = lexed.line_starts[line - 1];
    return lexed.text.find_first_not_of(" \t\r", first) == lexed.line_starts[line] - 1;
}

/// The `:` before i goes with a `?` of the same statement: no label ends there.
bool is_within_choice(const std::vector<std::string>& words, size_t i) {
    size_t others = 0;
    for (--i; i-- > 0;) {
        if (is_one_of(words[i], {";", "{", "}"})) return false;
        if (words[i] == ":") ++others;
        if (words[i] == "?" && others-- == 0) return true;
    }
    return false;
}

/// The end of the statement that goes on at i; words.size() for none.
size_t end_of_rest(const std::vector<std::string>& words, size_t i) {
    for (int depth = 0; i < words.size(); ++i) {
        depth += is_one_of(words[i], {"(", "["}) ? 1 : is_one_of(words[i], {")", "]"}) ? -1 : 0;
        if (depth <= 0 && words[i] == ";") return i + 1;
        if (is_one_of(words[i], {"{", "}"})) break;
    }
    return words.size();
}

/// The normal form has the brace that closes `x = a ? b : c ;` behind its `:`, where it puts one: it belongs behind the
/// whole statement.
void close_behind_choices(UnitWords& words) {
    for (size_t i = 1; i + 1 < words.size(); ++i) {
        if (words.words[i] != "}" || words.words[i - 1] != ":" || !is_within_choice(words.words, i)) continue;
        size_t end = i;
        while (end < words.size() && words.words[end] == "}") ++end;
        const size_t behind = end_of_rest(words.words, end);
        if (behind == words.size()) continue;
        const auto rotate = [&](auto& of) {
            const auto at = [&](size_t place) { return of.begin() + static_cast<std::ptrdiff_t>(place); };
            std::rotate(at(i), at(end), at(behind));
        };
        rotate(words.words);
        if (!words.tokens.empty()) rotate(words.tokens);
    }
}

}  // namespace

bool runs_on_device(const ScannedFile& file, const Unit& unit) {
    if (unit.kind == UnitKind::Kernel) return true;
    for (uint32_t i = unit.tokens.first; i < unit.name_token; ++i)
        if (file.lexed.view(i) == "__device__" || file.lexed.view(i) == "__global__") return true;
    return false;
}

UnitWords words_of_unit(const ScannedFile& file, const Unit& unit) {
    UnitWords out;
    write_normal_form(file, unit, [&](std::string_view text, uint32_t token) {
        out.words.emplace_back(text);
        out.tokens.push_back(token);
    });
    // A brace that was added goes by the token after it, which is written next, or by the last one.
    for (size_t i = 0; i < out.size(); ++i) {
        const bool brace = out.words[i] == "{" || out.words[i] == "}";
        const bool next_too = i + 1 < out.size() && out.tokens[i + 1] == out.tokens[i];
        const bool last_too = i > 0 && out.tokens[i - 1] == out.tokens[i];
        if (brace && (next_too || last_too || file.lexed.view(out.tokens[i]) != out.words[i]))
            out.tokens[i] = UnitWords::kNoToken;
    }
    close_behind_choices(out);
    return out;
}

UnitWords words_of_record(const NormalText& text) {
    UnitWords out;
    for (const std::string_view word : without_prelude(text.words())) out.words.emplace_back(word);
    close_behind_choices(out);
    return out;
}

void add_functions_of_vectors(Language language, CalledForms& forms) {
    if (!traits_of(language).vectors) return;
    for (const std::string_view name : {"length", "dot", "cross", "normalize", "distance"})
        if (forms.function_for(std::string(name)).empty()) forms.add({name, "("});
}

UnitWords in_forms_of(const CalledForms& there, UnitWords words) {
    for (const auto& reword : {with_functions_for_methods, with_methods_for_functions}) {
        const Reworded said = reword(Words(words.words.begin(), words.words.end()), there);
        if (!said.any) continue;
        UnitWords out;
        for (const size_t from : said.from)
            if (!words.tokens.empty())
                out.tokens.push_back(from == Reworded::kMade ? UnitWords::kNoToken : words.tokens[from]);
        out.words = said.words;
        words = std::move(out);
    }
    return words;
}

std::set<size_t> paragraphs_of(const ScannedFile& file, const UnitWords& words) {
    std::set<size_t> out;
    const LexedText& lexed = file.lexed;
    for (size_t i = 1; i < words.size(); ++i) {
        if (words.is_added(i) || words.is_added(i - 1)) continue;
        const Token &last = lexed.tokens[words.tokens[i - 1]], &token = lexed.tokens[words.tokens[i]];
        for (uint32_t line = last.line + 1; line < token.line; ++line)
            if (is_blank_line(lexed, line)) out.insert(i);
    }
    return out;
}

uint32_t line_at(const ScannedFile& file, const UnitWords& words, size_t word) {
    while (word < words.size() && words.is_added(word)) ++word;
    return word < words.size() ? file.lexed.tokens[words.tokens[word]].line : 0;
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/unit_words.h"

#include <utility>

#include "porttool/normal/normal_form.h"
#include "porttool/normal/prelude.h"

namespace porttool {
namespace {

bool is_blank_line(const LexedText& lexed, uint32_t line) {
    const size_t first = lexed.line_starts[line - 1];
    return lexed.text.find_first_not_of(" \t\r", first) == lexed.line_starts[line] - 1;
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
    return out;
}

UnitWords words_of_record(const NormalText& text) {
    UnitWords out;
    for (const std::string_view word : without_prelude(text.words())) out.words.emplace_back(word);
    return out;
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

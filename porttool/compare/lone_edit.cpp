// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/lone_edit.h"

#include <map>

#include "porttool/compare/hints.h"
#include "porttool/compare/plain_statement.h"
#include "porttool/compare/renaming.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/compare/struct_fields.h"
#include "porttool/normal/prelude.h"

namespace porttool {
namespace {

/// Without what does nothing: `return ;` at the end of a function, and a value that is named and thrown away.
Words without_idle_statements(const Words& tokens) {
    Words out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        const bool starts = i == 0 || tokens[i - 1] == ";" || tokens[i - 1] == "{" || tokens[i - 1] == "}";
        const bool thrown_away = starts && i + 4 < tokens.size() && tokens[i] == "(" && tokens[i + 1] == "void" &&
                                 tokens[i + 2] == ")" && is_word_token(tokens[i + 3]) && tokens[i + 4] == ";";
        if (thrown_away)
            i += 4;
        else
            out.push_back(tokens[i]);
    }
    const auto ends_with_return = [&] {
        const size_t n = out.size();
        return n > 3 && out[n - 1] == "}" && out[n - 2] == ";" && out[n - 3] == "return";
    };
    while (ends_with_return()) out.erase(out.end() - 3, out.end() - 1);
    return out;
}

/// A prelude with a statement for each variable: `volatile int a, b;` declares two.
Words single_declarations(const Words& prelude) {
    Words block = {"{"};
    block.insert(block.end(), prelude.begin(), prelude.end());
    block.emplace_back("}");
    block = single_fields(block);
    return {block.begin() + 1, block.end() - 1};
}

/// How a prelude declares each variable: in plain words, and as written.
std::map<std::string, Statement> declarations_of(const Words& text, const PlainStatements& plain) {
    const Translator translator = [&](const Words& statement, bool) {
        std::vector<std::string> words = plain.translate(statement, true), out;
        for (size_t i = 0; i < words.size(); ++i) {
            const bool place = i + 2 < words.size() && words[i + 1] == "=" &&
                               (words[i] == "binding" || words[i] == "set" || words[i] == "location");
            if (place) i += 2;  // where the host puts it
            if (!place && words[i] != ",") out.push_back(words[i]);
        }
        return out;
    };
    std::map<std::string, Statement> out;
    const Words declarations = single_declarations(prelude_of(text));
    for (Statement& statement : split_statements(declarations, translator)) {
        const std::vector<std::string>& words = statement.common;
        size_t name = words.size();
        for (size_t i = 0; i < words.size() && words[i] != "["; ++i)
            if (is_word_token(words[i])) name = i;
        if (name == words.size()) continue;
        std::string key = words[name];
        out.emplace(std::move(key), std::move(statement));
    }
    return out;
}

/// Adds the variables that both texts use and that are declared otherwise now. One that only one text uses came or
/// went with a statement.
void add_changed_declarations(const Words& before, const Words& now, const PlainStatements& plain, Edit& edit) {
    const auto old_ones = declarations_of(before, plain), new_ones = declarations_of(now, plain);
    for (const auto& [name, declared] : old_ones) {
        const auto found = new_ones.find(name);
        if (found == new_ones.end() || found->second.key == declared.key) continue;
        edit.lost.push_back(declared.shown);
        edit.gained.push_back(found->second.shown);
    }
}

}  // namespace

LoneEdit lone_edit(const Words& before, const Words& now, UnitKind kind, Language language, const Dialect& dialect) {
    const PlainStatements plain(kind, language, dialect);
    const Translator translator = [&](const Words& statement, bool in_body) {
        return plain.translate(statement, in_body);
    };
    const auto is_code = kind == UnitKind::Function || kind == UnitKind::Kernel;
    const auto bare = [&](const Words& tokens) {
        if (kind == UnitKind::Struct) return data_fields(tokens);
        return is_code ? without_idle_statements(without_hints(without_prelude(tokens))) : tokens;
    };
    const Words old_text = bare(before);
    StatementEdit edit = statement_edit(old_text, bare(now), translator);
    LoneEdit out;
    out.means_nothing = edit.lost.empty() && edit.gained.empty();
    if (!out.means_nothing && is_code)
        if (const Words renamed = with_old_names(before, now, dialect); renamed != now) {
            StatementEdit named = statement_edit(old_text, bare(renamed), translator);
            out.means_nothing = named.lost.empty() && named.gained.empty();
        }
    if (!out.means_nothing) out.edit = shown_edit(edit);
    if (is_code) add_changed_declarations(before, now, plain, out.edit);
    out.means_nothing = out.means_nothing && out.edit.lost.empty();
    if (out.means_nothing) out.edit = edit_of(before, now);
    return out;
}

}  // namespace porttool

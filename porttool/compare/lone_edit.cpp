// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/lone_edit.h"

#include "porttool/compare/hints.h"
#include "porttool/compare/plain_statement.h"
#include "porttool/compare/renaming.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/compare/struct_fields.h"

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

}  // namespace

LoneEdit lone_edit(const Words& before, const Words& now, UnitKind kind, Language language, const Dialect& dialect) {
    const PlainStatements plain(kind, language, dialect);
    const Translator translator = [&](const Words& statement, bool in_body) {
        return plain.translate(statement, in_body);
    };
    const auto is_code = kind == UnitKind::Function || kind == UnitKind::Kernel;
    const auto bare = [&](const Words& tokens) {
        if (kind == UnitKind::Struct) return data_fields(tokens);
        return is_code ? without_idle_statements(without_hints(tokens)) : tokens;
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
    out.edit = out.means_nothing ? edit_of(before, now) : shown_edit(edit);
    return out;
}

}  // namespace porttool

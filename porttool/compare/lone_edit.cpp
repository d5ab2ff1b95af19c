// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/lone_edit.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "porttool/compare/hints.h"
#include "porttool/compare/plain_statement.h"
#include "porttool/compare/renaming.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/compare/struct_fields.h"
#include "porttool/compare/switch_cases.h"
#include "porttool/language/words.h"
#include "porttool/normal/prelude.h"

namespace porttool {
namespace {

/// The places of each `break ;` that ends a switch, where nothing is left to leave: only braces of blocks without a
/// head stand between it and the brace that closes the switch.
std::vector<bool> last_breaks(const Words& tokens) {
    enum class Block : uint8_t { Other, Switch, Bare };
    std::vector<bool> out(tokens.size());
    std::vector<Block> blocks;
    std::vector<bool> of_switch;  // the parentheses that are open
    bool head_of_switch = false;
    const auto is_last = [&](size_t i) {
        if (i + 1 >= tokens.size() || tokens[i + 1] != ";") return false;
        size_t depth = blocks.size();
        for (i += 2; depth > 0 && i < tokens.size() && tokens[i] == "}"; ++i)
            if (const Block block = blocks[--depth]; block != Block::Bare) return block == Block::Switch;
        return false;
    };
    for (size_t i = 0; i < tokens.size(); ++i) {
        const std::string_view before = i > 0 ? tokens[i - 1] : std::string_view();
        if (tokens[i] == "(") of_switch.push_back(before == "switch");
        if (tokens[i] == ")" && !of_switch.empty()) {
            head_of_switch = of_switch.back();
            of_switch.pop_back();
        }
        if (tokens[i] == "{") {
            const bool bare = before == ":" || before == ";" || before == "{" || before == "}";
            blocks.push_back(before == ")" && head_of_switch ? Block::Switch : bare ? Block::Bare : Block::Other);
        }
        if (tokens[i] == "}" && !blocks.empty()) blocks.pop_back();
        if (tokens[i] == "break") out[i] = is_last(i);
    }
    return out;
}

/// Without what does nothing: `return ;` at the end of a function, `break ;` at the end of a switch, and a value that
/// is named and thrown away.
Words without_idle_statements(const Words& tokens) {
    const std::vector<bool> last_break = last_breaks(tokens);
    Words out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        const bool starts = i == 0 || tokens[i - 1] == ";" || tokens[i - 1] == "{" || tokens[i - 1] == "}";
        const bool thrown_away = starts && i + 4 < tokens.size() && tokens[i] == "(" && tokens[i + 1] == "void" &&
                                 tokens[i + 2] == ")" && is_word_token(tokens[i + 3]) && tokens[i + 4] == ";";
        if (thrown_away)
            i += 4;
        else if (last_break[i])
            ++i;
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

/// What a prelude says: how it declares each variable, in plain words and as written, and what stands for itself.
struct Prelude {
    std::map<std::string, Statement> declared, said;
};

Prelude read_prelude(const Words& text, const PlainStatements& plain) {
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
    Prelude out;
    const Words declarations = single_declarations(prelude_of(text));
    for (Statement& statement : split_statements(declarations, translator)) {
        const std::vector<std::string>& words = statement.common;
        if (words.empty()) continue;
        if (words[0] == "#" || words[0] == "default" || words[0] == "template") {
            std::string key = statement.key;
            out.said.emplace(std::move(key), std::move(statement));
            continue;
        }
        size_t name = words.size();
        for (size_t i = 0; i < words.size() && words[i] != "["; ++i)
            if (is_word_token(words[i])) name = i;
        if (name == words.size()) continue;
        std::string key = words[name];
        out.declared.emplace(std::move(key), std::move(statement));
    }
    return out;
}

/// Adds the variables that both texts use and that are declared otherwise now. One that only one text uses came or
/// went with a statement. What a file says of the function itself, or of how it is compiled, is all there is.
void add_changed_declarations(const Words& before, const Words& now, const PlainStatements& plain, Edit& edit) {
    const Prelude old_one = read_prelude(before, plain), new_one = read_prelude(now, plain);
    for (const auto& [name, declared] : old_one.declared) {
        const auto found = new_one.declared.find(name);
        if (found == new_one.declared.end() || found->second.key == declared.key) continue;
        edit.lost.push_back(declared.shown);
        edit.gained.push_back(found->second.shown);
    }
    for (const auto& [key, said] : old_one.said)
        if (!new_one.said.contains(key)) edit.lost.push_back(said.shown);
    for (const auto& [key, said] : new_one.said)
        if (!old_one.said.contains(key)) edit.gained.push_back(said.shown);
}

/// `float a, b[4]`: numbers that nothing is done to here.
bool declares_numbers_alone(const Statement& statement) {
    const std::vector<std::string>& words = statement.common;
    if (words.size() < 2 || !is_type_word(words[0])) return false;
    return std::all_of(words.begin() + 1, words.end(), [](const std::string& word) {
        return is_word_token(word) || is_number_token(word) || word == "," || word == "[" || word == "]";
    });
}

/// A text without such declarations, and these with the number of the statement that heads their block.
struct ApartFromDeclarations {
    std::vector<std::string> statements, declarations;

    explicit ApartFromDeclarations(const std::vector<Statement>& text) {
        std::vector<size_t> number(text.size());
        std::set<std::string_view> seen;  // a name that was another's before is no matter of place
        for (size_t i = 0; i < text.size(); ++i) {
            number[i] = statements.size();
            const bool in_block = text[i].head != Statement::kNoHead && text[i].head < i;
            const bool is_new =
                std::none_of(text[i].common.begin(), text[i].common.end(), [&](const std::string& word) {
                    return is_word_token(word) && !is_type_word(word) && seen.contains(word);
                });
            seen.insert(text[i].common.begin(), text[i].common.end());
            if (in_block && is_new && declares_numbers_alone(text[i]))
                declarations.push_back(text[i].key + std::to_string(number[text[i].head]));
            else
                statements.push_back(text[i].key);
        }
        std::sort(declarations.begin(), declarations.end());
    }
};

/// True if all that an edit did was to declare numbers earlier or later in the same block. They have no value there.
bool only_moves_declarations(const StatementEdit& edit) {
    const ApartFromDeclarations before(edit.before), now(edit.now);
    return before.statements == now.statements && before.declarations == now.declarations;
}

/// Without what differs between languages: of defaults their values, of an instantiation its arguments.
std::string what_it_says(const Statement& said) {
    std::string out = said.common[0];
    bool counts = said.common[0] == "#";
    for (size_t i = 1; i < said.common.size(); ++i) {
        const std::string& word = said.common[i];
        if (said.common[0] == "template" && (word == "<" || word == ">")) counts = word == "<";
        if (said.common[0] == "default" && (word == "=" || word == ")")) counts = word == "=";
        if (counts) out += " " + word;
    }
    return out;
}

}  // namespace

LoneEdit lone_edit(const Words& before, const Words& now, UnitKind kind, Language language, const Dialect& dialect,
                   bool names_count) {
    PlainStatements plain(kind, language, dialect);
    plain.note_vectors_of(before);
    plain.note_vectors_of(now);
    const Translator translator = [&](const Words& statement, bool in_body) {
        return plain.translate(statement, in_body);
    };
    const auto is_code = kind == UnitKind::Function || kind == UnitKind::Kernel;
    const auto bare = [&](const Words& tokens) {
        if (kind == UnitKind::Struct) return data_fields(without_prelude(tokens));
        return is_code ? without_idle_statements(without_hints(without_prelude(tokens))) : tokens;
    };
    const Words old_text = bare(before);
    StatementEdit edit = statement_edit(old_text, bare(now), translator);
    LoneEdit out;
    out.means_nothing = (edit.lost.empty() && edit.gained.empty()) || (is_code && only_moves_declarations(edit));
    if (!out.means_nothing && is_code && !names_count)
        if (const Words renamed = with_old_names(before, now, dialect); renamed != now) {
            StatementEdit named = statement_edit(old_text, bare(renamed), translator);
            out.means_nothing = named.lost.empty() && named.gained.empty();
        }
    if (!out.means_nothing && is_code) out.means_nothing = with_sorted_cases(old_text) == with_sorted_cases(bare(now));
    if (!out.means_nothing) out.edit = shown_edit(edit);
    add_changed_declarations(before, now, plain, out.edit);
    out.means_nothing = out.means_nothing && out.edit.lost.empty() && out.edit.gained.empty();
    if (out.means_nothing) out.edit = edit_of(before, now);
    return out;
}

std::vector<std::string> declaration_changes(const Words& before, const Words& now, const PlainStatements& plain) {
    const Prelude old_one = read_prelude(before, plain), new_one = read_prelude(now, plain);
    std::vector<std::string> out;
    const auto add = [&](const Statement& from, const Statement& without, const char* sign) {
        std::vector<std::string> left = without.common;
        for (const std::string& word : from.common) {
            const auto same = std::find(left.begin(), left.end(), word);
            if (same == left.end())
                out.push_back(sign + word);
            else
                left.erase(same);
        }
    };
    for (const auto& [name, declared] : old_one.declared) {
        const auto found = new_one.declared.find(name);
        if (found == new_one.declared.end() || found->second.key == declared.key) continue;
        add(declared, found->second, "- ");
        add(found->second, declared, "+ ");
    }
    for (const auto& [key, said] : old_one.said)
        if (!new_one.said.contains(key)) out.push_back("- " + what_it_says(said));
    for (const auto& [key, said] : new_one.said)
        if (!old_one.said.contains(key)) out.push_back("+ " + what_it_says(said));
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace porttool

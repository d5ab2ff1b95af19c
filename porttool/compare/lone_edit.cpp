// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/lone_edit.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "porttool/compare/hints.h"
#include "porttool/compare/numbered_text.h"
#include "porttool/compare/plain_declarations.h"
#include "porttool/compare/plain_statement.h"
#include "porttool/compare/renaming.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/compare/struct_fields.h"
#include "porttool/compare/switch_cases.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/prelude.h"
#include "porttool/text/letters.h"
#include "porttool/value_graph/respelling.h"

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

/// The semicolon of the statement `( void ) a ;` at `i`, or 0.
size_t end_of_thrown_away(const Words& tokens, size_t i) {
    const auto is = [&](size_t at, std::string_view word) { return at < tokens.size() && tokens[at] == word; };
    const bool is_one = is(i, "(") && is(i + 1, "void") && is(i + 2, ")") && i + 3 < tokens.size() &&
                        is_word_token(tokens[i + 3]) && is(i + 4, ";");
    return is_one ? i + 4 : 0;
}

/// The same of a macro that is called so: `UNUSED ( a , b ) ;`.
size_t end_of_unused(const Words& tokens, size_t i) {
    const auto is = [&](size_t at, std::string_view word) { return at < tokens.size() && tokens[at] == word; };
    const auto is_name = [&](size_t at) { return at < tokens.size() && is_word_token(tokens[at]); };
    if (!is_name(i) || !says_unused(tokens[i]) || !is(i + 1, "(")) return 0;
    size_t at = i + 2;
    while (is_name(at) && is(at + 1, ",")) at += 2;
    return is_name(at) && is(at + 1, ")") && is(at + 2, ";") ? at + 2 : 0;
}

bool starts_statement(const Words& tokens, size_t i) {
    return i == 0 || tokens[i - 1] == ";" || tokens[i - 1] == "{" || tokens[i - 1] == "}";
}

/// The names that such macros name.
std::multiset<std::string_view> unused_in(const Words& tokens) {
    std::multiset<std::string_view> out;
    for (size_t i = 0; i < tokens.size(); ++i)
        if (const size_t end = starts_statement(tokens, i) ? end_of_unused(tokens, i) : 0; end != 0)
            for (size_t k = i + 2; k + 1 < end; k += 2) out.insert(tokens[k]);
    return out;
}

/// True if other names took the place of those that are not used: that is a slip, or the function's own parameters are
/// others, too.
bool exchanges_unused(const Words& before, const Words& now) {
    const std::multiset<std::string_view> then = unused_in(before), today = unused_in(now);
    return !std::includes(then.begin(), then.end(), today.begin(), today.end()) &&
           !std::includes(today.begin(), today.end(), then.begin(), then.end());
}

/// Without what does nothing: `return ;` at the end of a function, `break ;` at the end of a switch, a value that is
/// named and thrown away, and, if that is wanted, macros that do the same.
Words without_idle_statements(const Words& tokens, bool drop_unused) {
    const std::vector<bool> last_break = last_breaks(tokens);
    Words out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        const bool starts = starts_statement(tokens, i);
        size_t thrown_away = starts ? end_of_thrown_away(tokens, i) : 0;
        if (starts && thrown_away == 0 && drop_unused) thrown_away = end_of_unused(tokens, i);
        if (thrown_away != 0)
            i = thrown_away;
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

/// What a prelude says: how it declares each variable, in plain words and as written, and what stands for itself. A
/// file may declare a variable more than once.
struct Prelude {
    std::map<std::string, std::map<std::string, Statement>> declared;  ///< by the name, then by what is said
    std::map<std::string, Statement> said;
    std::map<std::string, std::string> group_sizes;  ///< of all `layout(...) in`, each part with how it is written

    /// Takes the words of `layout ( local_size_x = 64 local_size_y = 1 ) in` apart; sizes of 1 are those of none.
    bool takes_group_sizes(const Statement& statement) {
        const std::vector<std::string>& words = statement.common;
        if (words.size() < 5 || words[0] != "layout" || words[1] != "(" || words[words.size() - 2] != ")" ||
            words.back() != "in")
            return false;
        for (size_t i = 2, end = words.size() - 2; i < end;) {
            std::string part = words[i++];
            const bool is_size = part.starts_with("local_size_") && !part.ends_with("_id");
            while (i < end && (words[i] == "=" || words[i - 1] == "=")) part += " " + words[i++];
            if (!is_size || !part.ends_with(" = 1")) group_sizes.emplace(std::move(part), statement.shown);
        }
        return true;
    }
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
        const bool lays_out_all = words[0] == "layout" && is_one_of(words.back(), {"out", "uniform", "buffer"});
        if (is_one_of(words[0], {"#", "default", "template"}) || words.back() == "@" || lays_out_all) {
            std::string key = statement.key;
            out.said.emplace(std::move(key), std::move(statement));
            continue;
        }
        if (out.takes_group_sizes(statement)) continue;
        size_t name = words.size();
        for (size_t i = 0; i < words.size() && words[i] != "["; ++i)
            if (is_word_token(words[i])) name = i;
        if (name == words.size()) continue;
        auto& of_name = out.declared[words[name]];
        std::string key = statement.key;
        of_name.emplace(std::move(key), std::move(statement));
    }
    return out;
}

/// Adds what one of two tables has and the other lacks, as it is written.
template <class Table, class Shown>
void add_lacking(const Table& here, const Table& there, const Shown& shown, std::vector<std::string>& out) {
    for (const auto& [key, value] : here)
        if (const std::string& text = shown(value); !there.contains(key) && (out.empty() || out.back() != text))
            out.push_back(text);
}

/// Adds the variables that both texts use and that are declared otherwise now. One that only one text uses came or
/// went with a statement. What a file says of the function itself, or of how it is compiled, is all there is.
void add_changed_declarations(const Words& before, const Words& now, const PlainStatements& plain, Edit& edit) {
    const auto shown = [](const Statement& statement) -> const std::string& { return statement.shown; };
    const auto as_it_is = [](const std::string& text) -> const std::string& { return text; };
    const Prelude old_one = read_prelude(before, plain), new_one = read_prelude(now, plain);
    for (const auto& [name, declared] : old_one.declared) {
        const auto found = new_one.declared.find(name);
        if (found == new_one.declared.end()) continue;
        add_lacking(declared, found->second, shown, edit.lost);
        add_lacking(found->second, declared, shown, edit.gained);
    }
    add_lacking(old_one.group_sizes, new_one.group_sizes, as_it_is, edit.lost);
    add_lacking(new_one.group_sizes, old_one.group_sizes, as_it_is, edit.gained);
    add_lacking(old_one.said, new_one.said, shown, edit.lost);
    add_lacking(new_one.said, old_one.said, shown, edit.gained);
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

/// `struct @ final {`, `typedef struct @ {` and `class @ {` as `@ struct {`: another manner to name the same fields.
Words with_plain_struct_head(const Words& tokens) {
    const auto open = std::find(tokens.begin(), tokens.end(), "{");
    const bool is_plain = open != tokens.end() && std::all_of(tokens.begin(), open, [](std::string_view word) {
                              return is_one_of(word, {"typedef", "struct", "class", "final", "@"});
                          });
    if (!is_plain) return tokens;
    Words out = {"@", "struct"};
    out.insert(out.end(), open, tokens.end());
    if (out.size() > 2 && out.back() == "@") out.pop_back();
    return out;
}

/// True if an edit only spelled statements otherwise: see are_respelled().
bool only_respells(const Words& before, const Words& now, const Translator& translator, Language language,
                   const Dialect& dialect) {
    constexpr size_t kMost = 20'000;  // words
    if (before.size() + now.size() > kMost) return false;
    const NumberedText then(with_plain_declarations(before)), today(with_plain_declarations(now));
    const ReadingManner manner{dialect, traits_of(language).literals == Literals::Shading, {}, true};
    const std::vector<Statement> old_one = split_statements(then.words(), translator),
                                 new_one = split_statements(today.words(), translator);
    return are_respelled({old_one, manner}, {new_one, manner});
}

/// True if an edit only declares numbers together, or each by itself. Their order stays, so that it is no matter what
/// macros make of the words.
bool splits_declarations(const Words& before, const Words& now, const Translator& translator) {
    const StatementEdit edit =
        statement_edit(with_plain_declarations(before), with_plain_declarations(now), translator);
    return edit.lost.empty() && edit.gained.empty();
}

/// Without what differs between languages: of defaults their values, of an instantiation its arguments.
std::string what_it_says(const Statement& said) {
    std::string out = said.common[0];
    bool counts = is_one_of(said.common[0], {"#", "layout"}) || said.common.back() == "@";
    for (size_t i = 1; i < said.common.size(); ++i) {
        const std::string& word = said.common[i];
        if (said.common[0] == "template" && (word == "<" || word == ">")) counts = word == "<";
        if (said.common[0] == "default" && (word == "=" || word == ")")) counts = word == "=";
        if (counts) out += " " + word;
    }
    return out;
}

}  // namespace

bool says_unused(std::string_view name) {
    constexpr std::string_view kWord = "UNUSED";
    const size_t at = name.find(kWord);
    const auto ends_word = [&](size_t i) { return i >= name.size() || name[i] == '_'; };
    return at != std::string::npos && (at == 0 || name[at - 1] == '_') && ends_word(at + kWord.size()) &&
           std::none_of(name.begin(), name.end(), is_small_letter);
}

LoneEdit lone_edit(const Words& before, const Words& now, UnitKind kind, Language language, const Dialect& dialect,
                   bool names_count) {
    PlainStatements plain(kind, language, dialect);
    plain.note_vectors_of(before);
    plain.note_vectors_of(now);
    const Translator translator =
        translated_once([&](const Words& statement, bool in_body) { return plain.translate(statement, in_body); });
    const auto is_code = kind == UnitKind::Function || kind == UnitKind::Kernel;
    const bool drops_unused = is_code && !exchanges_unused(before, now);
    const auto bare = [&](const Words& tokens) {
        if (kind == UnitKind::Struct) return with_plain_struct_head(data_fields(without_prelude(tokens)));
        return is_code ? without_idle_statements(without_hints(without_prelude(tokens)), drops_unused) : tokens;
    };
    const Words old_text = bare(before);
    StatementEdit edit = statement_edit(old_text, bare(now), translator);
    LoneEdit out;
    out.means_nothing = (edit.lost.empty() && edit.gained.empty()) || (is_code && only_moves_declarations(edit));
    if (!out.means_nothing && is_code && !names_count)
        if (const Words renamed = with_old_names(before, now, dialect); renamed != now) {
            StatementEdit named = statement_edit(old_text, bare(renamed), translator);
            out.means_nothing = named.lost.empty() && named.gained.empty();
            if (named.now.size() == edit.now.size() && named.gained.size() < edit.gained.size()) {
                edit.lost = std::move(named.lost);  // what is left beside the renaming, in the names of today
                edit.gained = std::move(named.gained);
            }
        }
    if (!out.means_nothing && is_code) out.means_nothing = with_sorted_cases(old_text) == with_sorted_cases(bare(now));
    if (!out.means_nothing && is_code && splits_declarations(old_text, bare(now), translator))
        out.means_nothing = out.respells = true;
    if (!out.means_nothing && is_code && !names_count)
        out.means_nothing = out.respells = only_respells(old_text, bare(now), translator, language, dialect);
    if (!out.means_nothing) out.edit = shown_edit(edit);
    add_changed_declarations(before, now, plain, out.edit);
    out.means_nothing = out.means_nothing && out.edit.lost.empty() && out.edit.gained.empty();
    if (out.means_nothing) out.edit = edit_of(before, now);
    return out;
}

std::vector<std::string> declaration_changes(const Words& before, const Words& now, const PlainStatements& plain) {
    const Prelude old_one = read_prelude(before, plain), new_one = read_prelude(now, plain);
    std::vector<std::string> out;
    const auto words_lacking = [](const auto& here, const auto& there) {
        std::vector<std::string> words;
        for (const auto& [key, statement] : here)
            if (!there.contains(key)) words.insert(words.end(), statement.common.begin(), statement.common.end());
        return words;
    };
    const auto add = [&](const std::vector<std::string>& from, std::vector<std::string> left, const char* sign) {
        for (const std::string& word : from) {
            const auto same = std::find(left.begin(), left.end(), word);
            if (same == left.end())
                out.push_back(sign + word);
            else
                left.erase(same);
        }
    };
    for (const auto& [name, declared] : old_one.declared) {
        const auto found = new_one.declared.find(name);
        if (found == new_one.declared.end()) continue;
        const auto lost = words_lacking(declared, found->second), gained = words_lacking(found->second, declared);
        add(lost, gained, "- ");
        add(gained, lost, "+ ");
    }
    for (const auto& [part, shown] : old_one.group_sizes)
        if (!new_one.group_sizes.contains(part)) out.push_back("- " + part);
    for (const auto& [part, shown] : new_one.group_sizes)
        if (!old_one.group_sizes.contains(part)) out.push_back("+ " + part);
    for (const auto& [key, said] : old_one.said)
        if (!new_one.said.contains(key)) out.push_back("- " + what_it_says(said));
    for (const auto& [key, said] : new_one.said)
        if (!old_one.said.contains(key)) out.push_back("+ " + what_it_says(said));
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/defined_pieces.h"

#include <algorithm>
#include <map>
#include <set>

#include "porttool/difftest/prelude.h"
#include "porttool/language/words.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/unit_extent.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

constexpr size_t kMostTables = 256;  ///< of a file that are looked at: each takes a look at all of it

/// The name of a macro's directive: `# define NAME`.
std::string_view macro_name(const LexedText& lexed, const Directive& directive) {
    return directive.end_token >= directive.first_token + 3 ? lexed.view(directive.first_token + 2)
                                                            : std::string_view();
}

/// True for the `#ifndef NAME` of a header's guard.
bool is_guard(const ScannedFile& file, size_t i) {
    const std::vector<Directive>& all = file.lexed.directives;
    if (i + 1 >= all.size() || all[i + 1].kind != DirectiveKind::Define) return false;
    const Directive& one = all[i];
    return one.kind == DirectiveKind::If && one.end_token == one.first_token + 3 &&
           file.lexed.view(one.first_token + 1) == "ifndef" && all[i + 1].end_token == all[i + 1].first_token + 3 &&
           file.lexed.view(one.first_token + 2) == macro_name(file.lexed, all[i + 1]);
}

/// For each directive, those that decide about what follows it: of every open group the `#if` and what came after.
class Conditions {
    using Groups = std::vector<std::vector<uint32_t>>;  ///< of a header's guard an empty one

public:
    explicit Conditions(const ScannedFile& file) : file_(file) {
        Groups open;
        const std::vector<Directive>& all = file.lexed.directives;
        std::vector<uint32_t> met;  // the `#ifndef NAME` that a `#define NAME` has met
        for (uint32_t i = 0; i < all.size(); ++i) {
            if (all[i].kind == DirectiveKind::If) open.push_back({});
            const bool about = all[i].kind == DirectiveKind::If || all[i].kind == DirectiveKind::Elif ||
                               all[i].kind == DirectiveKind::Else;
            if (about && !open.empty() && !is_guard(file, i)) {
                if (all[i].kind != DirectiveKind::If && open.back().empty() && !met.empty())
                    open.back().push_back(met.back());
                open.back().push_back(i);
            }
            if (all[i].kind == DirectiveKind::Define && !open.empty() && open.back().size() == 1 &&
                asks_whether_not(open.back().front(), macro_name(file.lexed, all[i]))) {
                // What follows goes with it.
                met.push_back(open.back().front());
                open.back().clear();
                after_.emplace_back(all[i].end_token, open);
            } else if (all[i].kind == DirectiveKind::Define && !open.empty()) {
                for (const std::vector<uint32_t>& group : open)
                    if (group.size() == 1 && asks_whether_not(group.front(), macro_name(file.lexed, all[i])))
                        within_.emplace(group.front(), all[i].end_token);
            }
            if (all[i].kind == DirectiveKind::Endif && !open.empty()) open.pop_back();
            if (about || all[i].kind == DirectiveKind::Endif) after_.emplace_back(all[i].first_token, open);
        }
    }
    void set(Definition& definition) const {
        for (const std::vector<uint32_t>& group : open_at(definition.tokens.first))
            if (!is_past(group, definition))
                definition.conditions.insert(definition.conditions.end(), group.begin(), group.end());
        // A text that conditions stand in may leave others open than it began in.
        for (const std::vector<uint32_t>& group : open_at(definition.tokens.end - 1))
            if (!group.empty() && !is_past(group, definition)) ++definition.open_conditions;
    }

private:
    bool asks_whether_not(uint32_t directive, std::string_view name) const {
        const Directive& one = file_.lexed.directives[directive];
        return one.kind == DirectiveKind::If && one.end_token == one.first_token + 3 &&
               file_.lexed.view(one.first_token + 1) == "ifndef" && file_.lexed.view(one.first_token + 2) == name;
    }

    /// True for an `#ifndef NAME` in one of whose branches the name is defined: what it asked was asked before that.
    /// Macros stand in the order of the text, before all else, and another `#define NAME` is one of the branches.
    bool is_past(const std::vector<uint32_t>& group, const Definition& definition) const {
        const auto found = group.size() == 1 ? within_.find(group.front()) : within_.end();
        if (found == within_.end()) return false;
        return definition.kind != Definition::Kind::Macro ||
               (found->second <= definition.tokens.first && !asks_whether_not(group.front(), definition.name));
    }

    Groups open_at(uint32_t token) const {
        const auto after = std::upper_bound(after_.begin(), after_.end(), token,
                                            [](uint32_t at, const auto& entry) { return at < entry.first; });
        return after == after_.begin() ? Groups() : std::prev(after)->second;
    }

    const ScannedFile& file_;
    std::vector<std::pair<uint32_t, Groups>> after_;
    std::map<uint32_t, uint32_t> within_;  ///< of an `#ifndef NAME` where a `#define NAME` in one of its branches ends
};

/// The token before the bracket that the one at `close` closes; `first` where there is none.
uint32_t before_brackets(const LexedText& lexed, uint32_t first, uint32_t close) {
    int depth = 0;
    for (uint32_t i = close; i > first; --i) {
        const std::string_view word = lexed.view(i);
        if (word == ")" || word == "]" || word == "}") ++depth;
        if ((word == "(" || word == "[" || word == "{") && --depth == 0) return i - 1;
    }
    return first;
}

/// The name that a `typedef` or a `using NAME = ...;` gives; "" for others: of a function's type `R NAME(...)`, of a
/// pointer to one `R (CALL* NAME)(...)`, else what stands last beside attributes and bounds.
std::string_view type_name(const LexedText& lexed, TokenRange statement) {
    // using std::swap; what the prelude has is written as it is
    if (statement.end == statement.first + 5 && lexed.view(statement.first) == "using" &&
        lexed.view(statement.first + 1) == "std" && !prelude_names().contains(lexed.view(statement.first + 3)))
        return lexed.view(statement.first + 3);
    if (lexed.view(statement.first) == "using")
        return statement.end > statement.first + 3 && lexed.view(statement.first + 2) == "="
                   ? lexed.view(statement.first + 1)
                   : std::string_view();
    for (uint32_t i = statement.end - 1; i > statement.first;) {
        const std::string_view word = lexed.view(i);
        if (word == ")" || word == "]") {
            const uint32_t before = before_brackets(lexed, statement.first, i);
            const bool is_pointer = word == ")" && lexed.view(before) == ")";
            i = is_pointer ? before - 1 : before;
        } else if (lexed.tokens[i].kind == TokenKind::Identifier && !word_is(word, kTakesArguments)) {
            return word;
        } else {
            --i;
        }
    }
    return {};
}

Definition::Kind kind_of_unit(const LexedText& lexed, const Unit& unit) {
    if (unit.kind == UnitKind::Struct) return Definition::Kind::Struct;
    if (unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel) return Definition::Kind::Function;
    if (lexed.view(unit.tokens.first) == "#") return Definition::Kind::Macro;
    // What is only initialised before the start can change later.
    for (uint32_t i = unit.tokens.first; i < unit.name_token; ++i)
        if (lexed.view(i) == "thread_local" || lexed.view(i) == "constinit") return Definition::Kind::Variable;
    return Definition::Kind::Constant;
}

/// True where something in the file may write to a variable.
bool is_written_to(const ScannedFile& file, uint32_t declared) {
    const LexedText& lexed = file.lexed;
    const std::string_view name = lexed.view(declared);
    auto unit = file.units.end();
    bool has_own = false;  // the unit that is gone through has a local of that name
    for (uint32_t i = 0; i + 1 < lexed.tokens.size(); ++i) {
        if (lexed.view(i) != name) continue;
        if (const auto around = std::find_if(
                file.units.begin(), file.units.end(),
                [&](const Unit& one) { return !one.body.empty() && one.tokens.first <= i && i < one.tokens.end; });
            around != file.units.end() && around != unit) {
            unit = around;
            const std::vector<std::string> names = local_names(file, *unit);
            has_own = std::find(names.begin(), names.end(), name) != names.end();
        }
        if (has_own && unit != file.units.end() && i < unit->tokens.end) continue;
        if (i > 0 && (lexed.view(i - 1) == "++" || lexed.view(i - 1) == "--")) return true;
        uint32_t next = i + 1;
        for (int depth = 0; next < lexed.tokens.size(); ++next) {
            if (lexed.view(next) == "[") ++depth;
            if (lexed.view(next) == "]") --depth;
            if (depth == 0 && lexed.view(next) != "]") break;
        }
        if (next >= lexed.tokens.size()) return false;
        const std::string_view sign = lexed.view(next);
        if (i == declared) continue;
        if (sign == "++" || sign == "--" ||
            (sign.size() >= 1 && sign.back() == '=' && sign != "==" && sign != "!=" && sign != "<=" && sign != ">="))
            return true;
    }
    return false;
}

/// The whole of a table that has values and that nothing writes to, though it is not declared constant; empty for
/// others.
TokenRange table_of(const ScannedFile& file, const FileVariable& variable) {
    const LexedText& lexed = file.lexed;
    bool opened = false, own = false;  // nobody else sees a static one
    for (uint32_t i = variable.tokens.first; i < variable.name_token; ++i) own = own || lexed.view(i) == "static";
    int depth = 0;
    for (uint32_t i = variable.name_token; i < lexed.tokens.size(); ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "=" && depth == 0 && i + 1 < lexed.tokens.size() && (own || lexed.view(i + 1) == "{"))
            opened = true;
        if (word == "{") ++depth;
        if (word == "}") --depth;
        if ((word == ";" || word == "(") && depth == 0) {
            if (!opened || word == "(" || is_written_to(file, variable.name_token)) return {};
            return {variable.tokens.first, i + 1};
        }
    }
    return {};
}

/// Behind `)(int, float)`, what stands behind the bounds in a table of functions: `void (*NAME[3])(int, float)`; the
/// same place for others.
uint32_t behind_function_type(const LexedText& lexed, uint32_t at) {
    const auto count = static_cast<uint32_t>(lexed.tokens.size());
    if (at + 1 >= count || lexed.view(at) != ")" || lexed.view(at + 1) != "(") return at;
    for (uint32_t i = at + 1, depth = 0; i < count; ++i) {
        if (lexed.view(i) == "(") ++depth;
        if (lexed.view(i) == ")" && --depth == 0) return i + 1;
    }
    return at;
}

/// The statement of a table that begins to be named at `i`: `float NAME[3] = {1, 2, 3};`; empty for others.
TokenRange table_at(const LexedText& lexed, uint32_t i) {
    const auto count = static_cast<uint32_t>(lexed.tokens.size());
    if (lexed.tokens[i].kind != TokenKind::Identifier || i + 1 >= count || lexed.view(i + 1) != "[") return {};
    uint32_t at = i + 1;
    for (int depth = 0; at < count; ++at) {
        if (lexed.view(at) == "[") ++depth;
        if (lexed.view(at) == "]") --depth;
        if (depth == 0 && lexed.view(at) != "]") break;
    }
    if (at < count && i > 1 && lexed.view(i - 1) == "*") at = behind_function_type(lexed, at);
    if (at + 1 >= count || lexed.view(at) != "=" || lexed.view(at + 1) != "{") return {};
    uint32_t first = i;
    while (first > 0 && lexed.view(first - 1) != ";" && lexed.view(first - 1) != "}" && lexed.view(first - 1) != "{" &&
           (lexed.tokens[first - 1].flags & kInDirective) == 0)
        --first;
    for (int depth = 0; at < count; ++at) {
        if (lexed.view(at) == "{") ++depth;
        if (lexed.view(at) == "}") --depth;
        if (lexed.view(at) == ";" && depth == 0) return {first, at + 1};
    }
    return {};
}

/// The macros of a file by which tables begin and end: `BEGIN(float, row, 3) 1, 2, 3 END()` where those stand for
/// `static const float row[3] = {` and `};`.
class TableMacros {
public:
    explicit TableMacros(const LexedText& lexed) : lexed_(lexed) {
        for (const Directive& directive : lexed.directives)
            if (directive.kind == DirectiveKind::Define && directive.end_token > directive.first_token + kLeast)
                read({directive.first_token, directive.end_token});
    }

    /// The whole of the table that begins there, and the token that is its name; empty for others.
    std::pair<TokenRange, uint32_t> table_at(uint32_t i) const {
        const auto count = static_cast<uint32_t>(lexed_.tokens.size());
        const auto begins = begins_.find(lexed_.view(i));
        if (begins == begins_.end() || i + 1 >= count || lexed_.view(i + 1) != "(") return {};
        uint32_t argument = 0, name = 0, at = i + 2;
        for (; at < count && lexed_.view(at) != ")"; ++at) {
            if (lexed_.view(at) == "(") return {};
            if (lexed_.view(at) == ",") ++argument;
            if (argument == begins->second && lexed_.tokens[at].kind == TokenKind::Identifier) name = at;
        }
        for (; name != 0 && at < count && !begins_.contains(lexed_.view(at)); ++at) {
            if (!ends_.contains(lexed_.view(at)) || (lexed_.tokens[at].flags & kInDirective) != 0) continue;
            const bool calls = at + 2 < count && lexed_.view(at + 1) == "(" && lexed_.view(at + 2) == ")";
            return {{i, calls ? at + 3 : at + 1}, name};
        }
        return {};
    }

private:
    static constexpr uint32_t kLeast = 3;  ///< # define NAME and something

    void read(TokenRange macro) {
        const std::string_view name = lexed_.view(macro.first + 2);
        const uint32_t open = macro.first + 3;
        uint32_t body = open;
        std::vector<std::string_view> parameters;
        if (lexed_.view(open) == "(") {
            for (; body < macro.end && lexed_.view(body) != ")"; ++body)
                if (lexed_.tokens[body].kind == TokenKind::Identifier) parameters.push_back(lexed_.view(body));
            ++body;
        }
        if (body < macro.end && lexed_.view(body) == "}") ends_.insert(name);
        const bool opens =
            macro.end > body + 2 && lexed_.view(macro.end - 1) == "{" && lexed_.view(macro.end - 2) == "=";
        for (uint32_t i = body + 1; opens && i < macro.end; ++i) {
            if (lexed_.view(i) != "[") continue;
            const auto which = std::find(parameters.begin(), parameters.end(), lexed_.view(i - 1));
            if (which != parameters.end()) begins_.emplace(name, static_cast<uint32_t>(which - parameters.begin()));
            return;
        }
    }

    const LexedText& lexed_;
    std::map<std::string_view, uint32_t> begins_;  ///< with the place of the parameter that names the table
    std::set<std::string_view> ends_;
};

/// Goes through a file and cuts out what it defines.
class PieceCutter {
public:
    explicit PieceCutter(const ScannedFile& file)
        : file_(file), lexed_(file.lexed), conditions_(file), table_macros_(file.lexed) {}

    std::vector<Definition> run() {
        cut_units();
        cut_macros();
        cut_tables_and_types();
        cut_variables();
        return std::move(pieces_);
    }

private:
    void add(Definition::Kind kind, const Unit* unit, TokenRange tokens, std::string_view name,
             std::string_view owner = {}) {
        if (name.empty() || is_fixed_word(name)) return;
        Definition one{kind, &file_, unit, tokens, std::string(name), std::string(owner), {}, 0};
        conditions_.set(one);
        names_.insert(one.name);
        for (std::string& further : further_names(one)) names_.insert(std::move(further));
        pieces_.push_back(std::move(one));
    }

    /// The name of a struct: of `typedef struct ALIGNED {...} a;` that of the type, for its tag may be a macro that
    /// says how it lies in memory.
    std::string_view struct_name(const Unit& unit, TokenRange tokens) const {
        const std::string_view tag = bare_leaf_of(unit.name);
        if (tokens.end < tokens.first + 5 || lexed_.view(tokens.first) != "typedef") return tag;
        const uint32_t name = tokens.end - 2;
        const bool plain = lexed_.view(tokens.end - 1) == ";" && lexed_.view(name - 1) == "}" &&
                           lexed_.tokens[name].kind == TokenKind::Identifier;
        return plain ? lexed_.view(name) : tag;
    }

    void cut_units() {
        for (const Unit& unit : file_.units) {
            if (unit.kind == UnitKind::File) continue;
            const Definition::Kind kind = kind_of_unit(lexed_, unit);
            if (kind == Definition::Kind::Macro) continue;  // all directives are read below
            TokenRange tokens = extent_of(file_, unit).tokens;
            if (kind == Definition::Kind::Function) tokens.end = std::max(tokens.end, end_of_function(lexed_, unit));
            taken_.push_back(tokens);
            const std::string_view whole = unit.name;
            const std::string_view rest = whole.substr(std::min<size_t>(unit.namespace_length, whole.size()));
            const size_t last = rest.rfind("::");
            const bool is_member = last != std::string_view::npos;
            add(kind, &unit, tokens,
                kind == Definition::Kind::Struct ? struct_name(unit, tokens) : bare_leaf_of(unit.name),
                is_member ? bare_leaf_of(rest.substr(0, last)) : std::string_view());
        }
    }

    void cut_macros() {
        for (const Directive& directive : lexed_.directives)
            if (directive.kind == DirectiveKind::Define)
                add(Definition::Kind::Macro, nullptr, {directive.first_token, directive.end_token},
                    macro_name(lexed_, directive));
    }

    /// Where the `template <...>` of an alias begins that stands there; the place itself where it has none.
    uint32_t head_before(uint32_t alias) const {
        int depth = 0;
        for (uint32_t i = alias; i-- > 0 && !is_one_of(lexed_.view(i), {";", "{", "}"});) {
            if (lexed_.view(i) == ">") ++depth;
            if (lexed_.view(i) == ">>") depth += 2;
            if (lexed_.view(i) == "<") --depth;
            if (depth == 0) return i > 0 && lexed_.view(i) == "<" && lexed_.view(i - 1) == "template" ? i - 1 : alias;
        }
        return alias;
    }

    /// Those between the units.
    void cut_tables_and_types() {
        std::sort(taken_.begin(), taken_.end(), [](TokenRange a, TokenRange b) { return a.first < b.first; });
        const auto count = static_cast<uint32_t>(lexed_.tokens.size());
        auto next = taken_.begin();
        for (uint32_t i = 0; i < count; ++i) {
            while (next != taken_.end() && next->end <= i) ++next;
            if (next != taken_.end() && next->first <= i) {
                i = next->end - 1;
                continue;
            }
            if ((lexed_.tokens[i].flags & kInDirective) != 0) continue;  // a macro's text is written where it is used
            const std::string_view word = lexed_.view(i);
            if (const TokenRange table = table_at(lexed_, i); !table.empty()) {
                if (++tables_ <= kMostTables && !is_written_to(file_, i))
                    add(Definition::Kind::Constant, nullptr, table, word);
                i = table.end - 1;
                continue;
            }
            if (const auto [table, name] = table_macros_.table_at(i); !table.empty()) {
                if (++tables_ <= kMostTables && !is_written_to(file_, name))
                    add(Definition::Kind::Constant, nullptr, table, lexed_.view(name));
                i = table.end - 1;
                continue;
            }
            if (word != "typedef" && word != "using") continue;
            uint32_t end = i;
            while (end < count && lexed_.view(end) != ";") ++end;
            const TokenRange statement{i, std::min(end + 1, count)};
            add(Definition::Kind::Type, nullptr, {head_before(i), statement.end}, type_name(lexed_, statement));
            i = end;
        }
    }

    void cut_variables() {
        for (const FileVariable& variable : file_.variables) {
            const std::string_view name = lexed_.view(variable.name_token);
            if (variable.about != FileVariable::Declares) continue;
            cut_further(variable);
            if (names_.contains(name)) continue;
            const TokenRange whole = ++tables_ <= kMostTables ? table_of(file_, variable) : TokenRange();
            if (whole.empty())
                add(Definition::Kind::Variable, nullptr, variable.tokens, name);
            else
                add(Definition::Kind::Constant, nullptr, whole, name);
        }
    }

    /// The variables that a list has behind its first value: `b` of `int a = 1, b = 2;`.
    void cut_further(const FileVariable& variable) {
        constexpr uint32_t kLongest = 256;
        const auto count = static_cast<uint32_t>(lexed_.tokens.size());
        int depth = 0;
        for (uint32_t i = variable.name_token + 1; i + 1 < std::min(count, variable.name_token + kLongest); ++i) {
            const std::string_view word = lexed_.view(i);
            if (word == "(" || word == "[" || word == "{") ++depth;
            if (word == ")" || word == "]" || word == "}") --depth;
            if (depth < 0 || (word == ";" && depth == 0)) return;
            if (word != "," || depth != 0) continue;
            while (i + 2 < count && lexed_.view(i + 1) == "*") ++i;
            const std::string_view name = lexed_.view(i + 1);
            if (lexed_.tokens[i + 1].kind == TokenKind::Identifier && !names_.contains(name))
                add(Definition::Kind::Variable, nullptr, {i + 1, i + 2}, name);
        }
    }

    const ScannedFile& file_;
    const LexedText& lexed_;
    const Conditions conditions_;
    const TableMacros table_macros_;
    std::vector<Definition> pieces_;
    std::vector<TokenRange> taken_;  ///< by units
    std::set<std::string, std::less<>> names_;
    size_t tables_ = 0;
};

}  // namespace

bool is_fixed_word(std::string_view word) { return word == "const" || word_is(word, kTypePart | kQualifier); }

bool takes_arguments(const Definition& macro) {
    const LexedText& lexed = macro.file->lexed;
    const uint32_t i = macro.tokens.first + 3;  // # define NAME
    return i < macro.tokens.end && lexed.view(i) == "(" &&
           lexed.tokens[i - 1].offset + lexed.tokens[i - 1].length == lexed.tokens[i].offset;
}

uint32_t end_of_function(const LexedText& lexed, const Unit& unit) {
    const auto count = static_cast<uint32_t>(lexed.tokens.size());
    int depth = 0, rounds = 0;
    for (uint32_t i = unit.tokens.first; i < count; ++i) {
        const std::string_view word = lexed.view(i);
        if ((lexed.tokens[i].flags & (kOffStructure | kDead | kInDirective)) != 0) continue;
        if (word == "(") ++rounds;
        if (word == ")") --rounds;
        if (word == "{" && rounds == 0) ++depth;
        if (word == ";" && depth == 0 && rounds == 0) break;
        if (word != "}" || rounds != 0 || --depth != 0) continue;
        // `: x{1}, y{2} {`
        const std::string_view next = i + 1 < count ? lexed.view(i + 1) : std::string_view();
        if (next != "," && next != "{") return i + 1;
    }
    return unit.tokens.end;
}

std::vector<std::string> further_names(const Definition& one) {
    std::vector<std::string> out;
    if (one.kind != Definition::Kind::Type && one.kind != Definition::Kind::Struct &&
        one.kind != Definition::Kind::Constant)
        return out;
    const LexedText& lexed = one.file->lexed;
    uint32_t open = one.tokens.first;
    bool is_enum = false, is_typedef = false;
    for (; open < one.tokens.end && lexed.view(open) != "{" && lexed.view(open) != ";"; ++open) {
        is_enum = is_enum || lexed.view(open) == "enum";
        is_typedef = is_typedef || lexed.view(open) == "typedef";
    }
    if (open >= one.tokens.end || lexed.view(open) != "{" || (!is_enum && !is_typedef)) return out;
    int depth = 0;
    uint32_t i = open;
    for (; i < one.tokens.end; ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "{" || word == "(") ++depth;
        if (word == "}" || word == ")") --depth;
        if (depth == 0) break;
        const bool starts = i > open && (lexed.view(i - 1) == "{" || lexed.view(i - 1) == ",");
        if (is_enum && depth == 1 && starts && lexed.tokens[i].kind == TokenKind::Identifier) out.emplace_back(word);
    }
    if (is_typedef && one.kind == Definition::Kind::Struct && one.unit != nullptr)
        out.emplace_back(bare_leaf_of(one.unit->name));
    if (is_typedef)
        for (++i; i < one.tokens.end && lexed.view(i) != ";"; ++i)
            if (lexed.tokens[i].kind == TokenKind::Identifier) out.emplace_back(lexed.view(i));
    std::erase_if(out, [&](const std::string& name) { return name == one.name || is_fixed_word(name); });
    return out;
}

std::vector<Definition> pieces_of(const ScannedFile& file) { return PieceCutter(file).run(); }

}  // namespace porttool

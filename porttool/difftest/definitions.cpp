// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/definitions.h"

#include <algorithm>

#include "porttool/difftest/prelude.h"
#include "porttool/language/words.h"
#include "porttool/normal/unit_state.h"
#include "porttool/read/source_files.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/includes.h"
#include "porttool/sync/unit_extent.h"

namespace porttool {
namespace {

constexpr size_t kMostTables = 256;    ///< of a file that are looked at: each takes a look at all of it
constexpr size_t kMostHeaders = 2000;  ///< read for one side, beyond those that its globs name

std::string folder_of(std::string_view path) {
    const size_t slash = path.find_last_of('/');
    return slash == std::string_view::npos ? std::string() : std::string(path.substr(0, slash + 1));
}

/// Without `.` and `..`; "" for a path that leads out.
std::string plain_path(const std::string& path) {
    std::vector<std::string> parts;
    size_t at = 0;
    while (at <= path.size()) {
        const size_t end = std::min(path.find('/', at), path.size());
        const std::string part = path.substr(at, end - at);
        at = end + 1;
        if (part.empty() || part == ".") continue;
        if (part != "..") {
            parts.push_back(part);
        } else {
            if (parts.empty()) return {};
            parts.pop_back();
        }
    }
    std::string out;
    for (const std::string& part : parts) out += (out.empty() ? "" : "/") + part;
    return out;
}

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
public:
    explicit Conditions(const ScannedFile& file) : file_(file) {
        std::vector<std::vector<uint32_t>> open;
        const std::vector<Directive>& all = file.lexed.directives;
        for (uint32_t i = 0; i < all.size(); ++i) {
            if (all[i].kind == DirectiveKind::If) open.push_back({});
            const bool about = all[i].kind == DirectiveKind::If || all[i].kind == DirectiveKind::Elif ||
                               all[i].kind == DirectiveKind::Else;
            if (about && !open.empty() && !is_guard(file, i)) open.back().push_back(i);
            if (all[i].kind == DirectiveKind::Endif && !open.empty()) open.pop_back();
            if (about || all[i].kind == DirectiveKind::Endif) after_.emplace_back(all[i].first_token, open);
        }
    }
    void set(Definition& definition) const {
        for (const std::vector<uint32_t>& group : open_at(definition.tokens.first))
            definition.conditions.insert(definition.conditions.end(), group.begin(), group.end());
        // A text that conditions stand in may leave others open than it began in.
        for (const std::vector<uint32_t>& group : open_at(definition.tokens.end - 1))
            if (!group.empty()) ++definition.open_conditions;
    }

private:
    using Groups = std::vector<std::vector<uint32_t>>;  ///< of a header's guard an empty one

    Groups open_at(uint32_t token) const {
        const auto after = std::upper_bound(after_.begin(), after_.end(), token,
                                            [](uint32_t at, const auto& entry) { return at < entry.first; });
        return after == after_.begin() ? Groups() : std::prev(after)->second;
    }

    const ScannedFile& file_;
    std::vector<std::pair<uint32_t, Groups>> after_;
};

/// True for a word that every file means the same by, whatever some header makes of it for old compilers.
bool is_fixed(std::string_view word) { return word == "const" || word_is(word, kTypePart | kQualifier); }

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

}  // namespace

namespace {

/// True where one of these functions takes the same parameters, as copies of a helper in several files do.
bool is_known(const std::vector<const Definition*>& found, const Definition& one) {
    if (one.kind != Definition::Kind::Function || one.unit == nullptr || !one.conditions.empty()) return false;
    return std::any_of(found.begin(), found.end(), [&](const Definition* other) {
        if (other->kind != one.kind || other->file == one.file || other->owner != one.owner) return false;
        const TokenRange a = one.unit->parameters, b = other->unit->parameters;
        if (a.end - a.first != b.end - b.first) return false;
        for (uint32_t i = 0; i < a.end - a.first; ++i)
            if (one.file->lexed.view(a.first + i) != other->file->lexed.view(b.first + i)) return false;
        return true;
    });
}

/// True for languages one of which may use what the other defines: a header of C++ and a source of CUDA.
bool are_related(Language a, Language b) { return a == b || (!has_vector_types(a) && !has_vector_types(b)); }

/// True where what was found may stand beside others: overloads, or macros of a condition that may not hold.
bool goes_on(const std::vector<const Definition*>& found) {
    return std::all_of(found.begin(), found.end(), [](const Definition* one) {
        return one->kind == Definition::Kind::Function ||
               (one->kind == Definition::Kind::Macro && !one->conditions.empty());
    });
}

}  // namespace

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

std::string_view type_of_variable(const Definition& variable) {
    const LexedText& lexed = variable.file->lexed;
    const auto count = static_cast<uint32_t>(lexed.tokens.size());
    // Of a block of GLSL the tokens are its head, and the variable stands behind them.
    for (uint32_t i = variable.tokens.first + 1; i + 1 < std::min(variable.tokens.end + 16, count); ++i) {
        if (lexed.view(i) != variable.name) continue;
        const std::string_view next = lexed.view(i + 1);
        const bool alone = next == ";" || next == "=" || next == "{";
        return alone && lexed.tokens[i - 1].kind == TokenKind::Identifier ? lexed.view(i - 1) : std::string_view();
    }
    return {};
}

std::vector<const Definition*> Definitions::all_of(Definition::Kind kind) const {
    std::vector<const Definition*> out;
    for (const Definition& one : all_)
        if (one.kind == kind) out.push_back(&one);
    return out;
}

const Definition* Definitions::add(Definition definition) {
    if (definition.name.empty() || is_fixed(definition.name)) return nullptr;
    all_.push_back(std::move(definition));
    const Definition* const one = &all_.back();
    by_file_[one->file][one->name].push_back(one);
    everywhere_[one->name].push_back(one);
    return one;
}

void Definitions::add_names(const Definition& one) {
    const LexedText& lexed = one.file->lexed;
    const auto name_it = [&](std::string_view name) {
        if (name == one.name || is_fixed(name)) return;
        by_file_[one.file][std::string(name)].push_back(&one);
        everywhere_[std::string(name)].push_back(&one);
    };
    uint32_t open = one.tokens.first;
    bool is_enum = false, is_typedef = false;
    for (; open < one.tokens.end && lexed.view(open) != "{" && lexed.view(open) != ";"; ++open) {
        is_enum = is_enum || lexed.view(open) == "enum";
        is_typedef = is_typedef || lexed.view(open) == "typedef";
    }
    if (open >= one.tokens.end || lexed.view(open) != "{" || (!is_enum && !is_typedef)) return;
    int depth = 0;
    uint32_t i = open;
    for (; i < one.tokens.end; ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "{" || word == "(") ++depth;
        if (word == "}" || word == ")") --depth;
        if (depth == 0) break;
        const bool starts = i > open && (lexed.view(i - 1) == "{" || lexed.view(i - 1) == ",");
        if (is_enum && depth == 1 && starts && lexed.tokens[i].kind == TokenKind::Identifier) name_it(word);
    }
    if (is_typedef)
        for (++i; i < one.tokens.end && lexed.view(i) != ";"; ++i)
            if (lexed.tokens[i].kind == TokenKind::Identifier) name_it(lexed.view(i));
}

void Definitions::add_file(const ScannedFile& file) {
    const LexedText& lexed = file.lexed;
    const Conditions conditions(file);
    const auto add_with = [&](Definition definition) {
        conditions.set(definition);
        const Definition* const added = add(std::move(definition));
        const bool has_names = added != nullptr && added->kind != Definition::Kind::Function &&
                               added->kind != Definition::Kind::Macro && added->kind != Definition::Kind::Variable;
        if (has_names) add_names(*added);
    };
    size_t tables = 0;
    std::vector<TokenRange> taken;
    for (const Unit& unit : file.units) {
        if (unit.kind == UnitKind::File) continue;
        Definition one{
            kind_of_unit(lexed, unit), &file, &unit, unit.tokens, std::string(bare_leaf_of(unit.name)), {}, {}, 0};
        if (one.kind == Definition::Kind::Macro) continue;  // all directives are read below
        one.tokens = extent_of(file, unit).tokens;
        if (one.kind == Definition::Kind::Function)
            one.tokens.end = std::max(one.tokens.end, end_of_function(lexed, unit));
        taken.push_back(one.tokens);
        const std::string_view spaces = std::string_view(unit.name).substr(0, unit.namespace_length);
        for (size_t at = 0; at < spaces.size();) {
            const size_t end = std::min(spaces.find("::", at), spaces.size());
            if (end > at) namespaces_.insert(std::string(spaces.substr(at, end - at)));
            at = end + 2;
        }
        const std::string_view rest =
            std::string_view(unit.name).substr(std::min<size_t>(unit.namespace_length, unit.name.size()));
        const size_t last = rest.rfind("::");
        if (last != std::string_view::npos) one.owner = bare_leaf_of(rest.substr(0, last));
        add_with(std::move(one));
    }
    for (const Directive& directive : lexed.directives)
        if (directive.kind == DirectiveKind::Define)
            add_with({Definition::Kind::Macro,
                      &file,
                      nullptr,
                      {directive.first_token, directive.end_token},
                      std::string(macro_name(lexed, directive)),
                      {},
                      {},
                      0});
    std::sort(taken.begin(), taken.end(), [](TokenRange a, TokenRange b) { return a.first < b.first; });
    auto next = taken.begin();
    for (uint32_t i = 0; i < lexed.tokens.size(); ++i) {
        while (next != taken.end() && next->end <= i) ++next;
        if (next != taken.end() && next->first <= i) {
            i = next->end - 1;
            continue;
        }
        if ((lexed.tokens[i].flags & kInDirective) != 0) continue;  // what a macro writes is written where it is used
        const std::string_view word = lexed.view(i);
        if (const TokenRange table = table_at(lexed, i); !table.empty()) {
            if (++tables <= kMostTables && !is_written_to(file, i))
                add_with({Definition::Kind::Constant, &file, nullptr, table, std::string(word), {}, {}, 0});
            i = table.end - 1;
            continue;
        }
        if (word != "typedef" && word != "using") continue;
        uint32_t end = i;
        while (end < lexed.tokens.size() && lexed.view(end) != ";") ++end;
        const TokenRange statement{i, std::min<uint32_t>(end + 1, static_cast<uint32_t>(lexed.tokens.size()))};
        add_with(
            {Definition::Kind::Type, &file, nullptr, statement, std::string(type_name(lexed, statement)), {}, {}, 0});
        i = end;
    }
    for (const FileVariable& variable : file.variables) {
        const std::string name(lexed.view(variable.name_token));
        if (variable.about != FileVariable::Declares || by_file_[&file].contains(name)) continue;
        const TokenRange whole = ++tables <= kMostTables ? table_of(file, variable) : TokenRange();
        if (whole.empty())
            add_with({Definition::Kind::Variable, &file, nullptr, variable.tokens, name, {}, {}, 0});
        else
            add_with({Definition::Kind::Constant, &file, nullptr, whole, name, {}, {}, 0});
    }
}

Definitions::Definitions(const std::vector<ScannedFile>& files, const std::string& root, const Disk& disk,
                         const std::vector<std::string>& preamble, const BuildDefines& build)
    : root_(root), disk_(disk), build_(build) {
    for (const ScannedFile& file : files) paths_.emplace(file.path, &file);
    for (const ScannedFile& file : files) add_file(file);
    if (!preamble.empty()) {
        read_.push_back(scan_text("preamble.glsl", preamble.front()));
        preamble_ = &read_.back();
        add_file(*preamble_);
    }
    for (const ScannedFile& file : files) (void)reached(file);
    namespaces_.erase("std");
}

const ScannedFile* Definitions::included(const ScannedFile& from, std::string_view what) const {
    const std::string here = folder_of(from.path);
    std::vector<std::string> tried = {plain_path(here + std::string(what))};
    for (std::string above = here;; above = folder_of(above.substr(0, above.size() - 1))) {
        for (const char* folder : {"", "include/", "src/"})
            tried.push_back(plain_path(above + folder + std::string(what)));
        if (above.empty()) break;
    }
    for (const std::string& path : tried) {
        if (path.empty()) continue;
        if (const auto known = paths_.find(path); known != paths_.end()) return known->second;
    }
    for (const std::string& path : tried) {
        if (path.empty()) continue;
        const auto [at, is_new] = headers_.try_emplace(path, nullptr);
        if (at->second != nullptr) return at->second;
        if (!is_new || headers_.size() > kMostHeaders) continue;
        const FileText text = disk_.read(TreePath{root_, path}, kLargestSource);
        if (!text.error.empty() || !unreadable_reason(text.bytes).empty()) continue;
        read_.push_back(scan_text(path, text.bytes));
        at->second = &read_.back();
        const_cast<Definitions*>(this)->add_file(read_.back());
        return at->second;
    }
    return nullptr;
}

const Definitions::Includes& Definitions::includes(const ScannedFile& file) const {
    const auto [at, is_new] = includes_.try_emplace(&file);
    if (!is_new) return at->second;
    Includes out;
    for (const IncludeLine& line : include_lines(file)) {
        if (line.what.size() < 3) continue;
        const ScannedFile* const other = included(file, std::string_view(line.what).substr(1, line.what.size() - 2));
        if (other != nullptr) out.emplace_back(line.next, other);
    }
    return includes_[&file] = std::move(out);
}

const std::vector<const ScannedFile*>& Definitions::reached(const ScannedFile& from) const {
    const auto [at, is_new] = reached_.try_emplace(&from);
    if (!is_new) return at->second;
    std::vector<const ScannedFile*> out = {&from};
    std::set<const ScannedFile*> seen = {&from};
    for (size_t i = 0; i < out.size(); ++i)
        for (const auto& [behind, file] : includes(*out[i]))
            if (seen.insert(file).second) out.push_back(file);
    return reached_[&from] = std::move(out);
}

std::pair<size_t, size_t> ReadingOrder::place(const ScannedFile& file, size_t offset) const {
    const auto parts = parts_.find(&file);
    if (parts == parts_.end()) return {0, offset};
    const auto after = std::upper_bound(parts->second.begin(), parts->second.end(), offset,
                                        [](size_t at, const auto& part) { return at < part.first; });
    return {after == parts->second.begin() ? 0 : std::prev(after)->second, offset};
}

ReadingOrder Definitions::reading_order(const std::vector<const ScannedFile*>& files) const {
    ReadingOrder out;
    std::set<const ScannedFile*> entered;
    std::vector<std::pair<const ScannedFile*, size_t>> open;
    const auto enter = [&](const ScannedFile* file) {
        // What the build defines stands before all.
        if (of_build_.contains(file) || !entered.insert(file).second) return;
        out.add(*file, 0);
        open.emplace_back(file, 0);
    };
    for (const ScannedFile* from : files) {
        enter(from);
        while (!open.empty()) {
            const auto [file, next] = open.back();
            const Includes& others = includes(*file);
            if (next > 0) out.add(*file, others[next - 1].first);
            if (next == others.size()) {
                open.pop_back();
                continue;
            }
            ++open.back().second;
            enter(others[next].second);
        }
    }
    return out;
}

const ScannedFile* Definitions::build_text(const ScannedFile& from) const {
    const std::string& text = build_.text_for(from.path);
    if (text.empty()) return nullptr;
    const auto [at, is_new] = build_texts_.try_emplace(text, nullptr);
    if (is_new) {
        read_.push_back(scan_text("build_flags.h", text));
        at->second = &read_.back();
        of_build_.insert(at->second);
        const_cast<Definitions*>(this)->add_file(read_.back());
    }
    return at->second;
}

std::vector<const ScannedFile*> Definitions::all_reached(const ScannedFile& from) const {
    std::vector<const ScannedFile*> out = reached(from);
    if (preamble_ != nullptr) out.push_back(preamble_);
    if (const ScannedFile* const build = build_text(from); build != nullptr) out.push_back(build);
    return out;
}

const std::vector<const Definition*>& Definitions::find(const ScannedFile& from, std::string_view name) const {
    const auto [at, is_new] = found_.try_emplace({&from, std::string(name)});
    if (!is_new) return at->second;
    for (const ScannedFile* file : all_reached(from)) {
        const auto names = by_file_.find(file);
        if (names == by_file_.end()) continue;
        if (const auto found = names->second.find(name); found != names->second.end()) {
            // Overloads of one name stand in several files as well: math.h and color.h.
            if (at->second.empty() || goes_on(at->second))
                for (const Definition* one : found->second)
                    if (!is_known(at->second, *one)) at->second.push_back(one);
            if (!goes_on(at->second)) break;
        }
    }
    const bool only_conditional =
        !at->second.empty() && at->second.back()->kind == Definition::Kind::Macro && goes_on(at->second);
    if ((!at->second.empty() && !only_conditional) || is_prelude_word(name)) return at->second;
    const auto other = everywhere_.find(name);
    if (other == everywhere_.end()) return at->second;
    const std::string folder = folder_of(from.path);
    const ScannedFile* best = nullptr;
    for (const Definition* one : other->second) {
        if (of_build_.contains(one->file)) continue;  // that of another folder
        if (one->kind == Definition::Kind::Variable || !are_related(one->file->language, from.language)) continue;
        if (only_conditional && one->kind == Definition::Kind::Macro) continue;
        if (best == nullptr || (folder_of(one->file->path) == folder && folder_of(best->path) != folder))
            best = one->file;
    }
    for (const Definition* one : other->second)
        if (one->file == best && !(only_conditional && one->kind == Definition::Kind::Macro)) at->second.push_back(one);
    return at->second;
}

std::vector<const Definition*> Definitions::find_macro(const ScannedFile& from, std::string_view name) const {
    for (const ScannedFile* file : all_reached(from)) {
        const auto names = by_file_.find(file);
        if (names == by_file_.end()) continue;
        if (const auto found = names->second.find(name); found != names->second.end()) return found->second;
    }
    return {};
}

std::vector<const Definition*> Definitions::operators(const ScannedFile& from, std::string_view type) const {
    std::vector<const Definition*> out;
    for (const ScannedFile* file : reached(from)) {
        const auto names = by_file_.find(file);
        if (names == by_file_.end()) continue;
        for (auto at = names->second.lower_bound("operator");
             at != names->second.end() && at->first.starts_with("operator"); ++at)
            for (const Definition* one : at->second) {
                if (one->unit == nullptr || !one->owner.empty()) continue;
                const TokenRange parameters = one->unit->parameters;
                bool about = false;
                for (uint32_t i = parameters.first; i < parameters.end && !about; ++i)
                    about = file->lexed.view(i) == type;
                if (about) out.push_back(one);
            }
    }
    return out;
}

std::vector<const Definition*> Definitions::members(std::string_view owner) const {
    std::vector<const Definition*> out;
    for (const Definition& one : all_)
        if (one.kind == Definition::Kind::Function && one.owner == owner) out.push_back(&one);
    return out;
}

const Definition* Definitions::of_unit(const ScannedFile& file, const Unit& unit) const {
    const auto names = by_file_.find(&file);
    if (names == by_file_.end()) return nullptr;
    const auto found = names->second.find(bare_leaf_of(unit.name));
    if (found == names->second.end()) return nullptr;
    for (const Definition* one : found->second)
        if (one->unit == &unit) return one;
    return nullptr;
}

std::set<std::string> Definitions::standard_headers(const ScannedFile& from) const {
    std::set<std::string> out;
    for (const ScannedFile* file : reached(from))
        for (const IncludeLine& line : include_lines(*file))
            if (const std::string known = standard_include(line.what, Language::Cpp); !known.empty()) out.insert(known);
    return out;
}

}  // namespace porttool

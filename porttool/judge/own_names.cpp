// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/own_names.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "porttool/compare/added_branches.h"
#include "porttool/language/spelling.h"
#include "porttool/match/words.h"
#include "porttool/normal/locals.h"
#include "porttool/scan/declared_words.h"
#include "porttool/scan/scan.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// What a unit is known by: an entry point, which has the name of all others, by that of its file.
std::string_view known_name(const UnitState& unit) {
    const std::string_view leaf = bare_leaf_of(unit.name);
    return leaf == "main" ? file_stem(unit.file) : leaf;
}

/// What stands before the last part of a unit's name: `a::b::` of `a::b::f`.
std::string_view scope_of_unit(std::string_view name) {
    const size_t last = name.rfind("::");
    return last == std::string_view::npos ? std::string_view() : name.substr(0, last + 2);
}

/// The class, or the namespace, that a unit is in; "" for none.
std::string_view class_of(const UnitState& unit) {
    const std::string_view scope = scope_of_unit(unit.name);
    return scope.empty() ? scope : leaf_of(scope.substr(0, scope.size() - 2));
}

/// True if `scope` is some of the scopes of a unit, in order: `b::` of `a::b::c::f`.
bool is_around(std::string_view scope, const UnitState& unit) {
    const std::string_view all = scope_of_unit(unit.name);
    const size_t at = all.find(scope);
    return at != std::string_view::npos && (at == 0 || all[at - 1] == ':');
}

/// `native::`, `metal::fast::`.
bool stands_for_precision(std::string_view scope) {
    while (!scope.empty()) {
        const std::string_view part = scope.substr(0, scope.find("::"));
        if (names_precision(part)) return true;
        scope.remove_prefix(std::min(scope.size(), part.size() + 2));
    }
    return false;
}

/// True for what C has for whole numbers alone, in languages where that may be meant: `abs` is not `std::abs`.
bool is_of_whole_numbers_alone(std::string_view name, const UnitState& unit) {
    const Language language = language_of_path(unit.file);
    return name == "abs" && (language == Language::Cpp || language == Language::Sycl);
}

/// The next name in a text from `at` on, which is behind it then; "" for none before `end`.
std::string_view next_name(std::string_view text, size_t& at, size_t end) {
    const auto is_letter = [&](size_t i) {
        const auto c = static_cast<unsigned char>(text[i]);
        return c == '_' || std::isalnum(c) != 0;
    };
    while (at < end && !is_letter(at)) ++at;
    const size_t first = at;
    while (at < end && is_letter(at)) ++at;
    return text.substr(first, at - first);
}

/// Where a line of the preprocessor ends.
size_t end_of_line(std::string_view text, size_t at) {
    size_t end = std::min(text.find('\n', at), text.size());
    while (end < text.size() && end > 0 && (text[end - 1] == '\\' || (text[end - 1] == '\r' && text[end - 2] == '\\')))
        end = std::min(text.find('\n', end + 1), text.size());
    return end;
}

/// A path as text_of() has it: `a :: b`.
std::string path_apart(std::string_view path) {
    std::string out;
    for (size_t at = 0;;) {
        const size_t end = path.find("::", at);
        out += path.substr(at, end - at);
        if (end == std::string_view::npos) return out;
        out += " :: ";
        at = end + 2;
    }
}

/// True if some of the words are these, one after another.
bool has_in_a_row(const Words& words, std::string_view apart_by_blanks) {
    std::vector<std::string_view> wanted;
    for (size_t at = 0; at < apart_by_blanks.size();) {
        const size_t end = std::min(apart_by_blanks.find(' ', at), apart_by_blanks.size());
        wanted.push_back(apart_by_blanks.substr(at, end - at));
        at = end + 1;
    }
    return std::search(words.begin(), words.end(), wanted.begin(), wanted.end()) != words.end();
}

/// True if a file has the word elsewhere than in a comment, and behind `before`, if that is a word.
bool is_in_tokens(const LexedText& lexed, std::string_view word, std::string_view before) {
    std::string_view last;
    for (const Token& token : lexed.tokens) {
        if (lexed.view(token) == word && (before.empty() || last == before)) return true;
        last = lexed.view(token);
    }
    return false;
}

/// The same of some file of a side.
bool is_in_code_after(const Case& facts, Side side, std::string_view word, std::string_view before) {
    const FilesOfSide& files = (*facts.files)[side];
    for (size_t i = 0; i < files.size(); ++i)
        if (says_word(files.text(i), word) && is_in_tokens(files.scanned(i).lexed, word, before)) return true;
    return false;
}

/// `SCALE`, `USE_FOG_2`.
bool is_in_capitals(std::string_view word) {
    constexpr size_t kLeast = 3;  // `N`, `PI`: of templates, mostly
    return word.size() >= kLeast && is_word_token(word) &&
           std::none_of(word.begin(), word.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

/// True if a file defines or declares the word: behind `define` or a type, or between the braces of an `enum`.
bool is_declared_in(const LexedText& lexed, std::string_view word) {
    std::string_view last;
    bool in_enum = false;
    for (const Token& token : lexed.tokens) {
        const std::string_view text = lexed.view(token);
        in_enum = text == "enum" || (in_enum && text != ";" && text != "}");
        const bool is_behind_type =
            is_word_token(last) && !is_one_of(last, {"return", "case", "else", "goto", "throw", "if", "ifdef", "ifndef",
                                                     "elif", "undef", "defined", "do", "in", "sizeof"});
        if (text == word && (in_enum || is_behind_type)) return true;
        last = text;
    }
    return false;
}

}  // namespace

const std::vector<const UnitState*>* OwnNames::of(Side side, std::string_view name) {
    if (!by_name_[side]) {
        ByName& names = by_name_[side].emplace();
        for (const auto& [id, unit] : facts_.units(side))
            if (unit.kind != UnitKind::File) names[bare_leaf_of(unit.name)].push_back(&unit);
    }
    const auto found = by_name_[side]->find(name);
    return found == by_name_[side]->end() ? nullptr : &found->second;
}

bool OwnNames::are_one(const BySide<const UnitState*>& units) {
    const BySide<std::string_view> names{known_name(*units.source), known_name(*units.target)};
    if (names.source != names.target) return false;
    if (class_of(*units.source) == class_of(*units.target)) return true;
    const auto is_of_one_class = [&](Side side) {
        const std::vector<const UnitState*>* bearers = of(side, names[side]);
        return bearers == nullptr || std::all_of(bearers->begin(), bearers->end(), [&](const UnitState* bearer) {
                   return class_of(*bearer) == class_of(*bearers->front());
               });
    };
    return is_of_one_class(Side::Source) && is_of_one_class(Side::Target);
}

bool OwnNames::is_one_thing(const RescopedName& name, const UnitState& unit, Side side) {
    if (name.scope.empty()) return true;
    if (is_of_whole_numbers_alone(name.name, unit)) return false;
    const bool of_library = is_scope_of_library(name.scope);
    if (!of_library && (stands_for_precision(name.scope) ||
                        !(is_around(name.scope, unit) || is_seen_without(name.scope, name.name, unit, side))))
        return false;
    const std::vector<const UnitState*>* own = of(side, name.name);
    return own == nullptr || std::all_of(own->begin(), own->end(), [&](const UnitState* other) {
               const std::string_view scope = scope_of_unit(other->name);
               if (!of_library && (scope == name.scope || scope.ends_with("::" + name.scope))) return true;
               const bool is_seen = scope.empty() || is_around(scope, unit);
               return !is_seen && !is_seen_without(scope, name.name, unit, side);
           });
}

bool OwnNames::are_locals_in_macros(const Words& text, Side side) const {
    if (!facts_.files) return false;
    const std::vector<size_t> numbers = local_numbers(text);
    std::set<std::string_view> locals, used;
    for (size_t i = 0; i < text.size(); ++i) (i < numbers.size() && numbers[i] != 0 ? locals : used).insert(text[i]);
    const FilesOfSide& files = (*facts_.files)[side];
    constexpr std::string_view kDefine = "define";
    for (size_t i = 0; i < files.size(); ++i) {
        const std::string_view file = files.text(i);
        for (size_t at = file.find(kDefine); at != std::string_view::npos; at = file.find(kDefine, at)) {
            at += kDefine.size();
            const size_t end = end_of_line(file, at);
            if (!used.contains(next_name(file, at, end))) continue;
            while (at < end)
                if (locals.contains(next_name(file, at, end))) return true;
        }
    }
    return false;
}

std::string OwnNames::macro_of_elsewhere(const Words& text, Side side, const Dialect& dialect) {
    if (!facts_.files) return {};
    const std::vector<size_t> numbers = local_numbers(text);
    const FilesOfSide& files = (*facts_.files)[side];
    const auto is_declared = [&](std::string_view word) {
        for (size_t i = 0; i < files.size(); ++i)
            if (says_word(files.text(i), word) && is_declared_in(files.scanned(i).lexed, word)) return true;
        return false;
    };
    for (size_t i = 0; i < text.size(); ++i) {
        const bool is_known = !is_in_capitals(text[i]) || (i < numbers.size() && numbers[i] != 0) ||
                              dialect.meaning(text[i]) != nullptr || is_macro_of_compilers(text[i]) ||
                              is_one_of(text[i], {"NAN", "NULL", "TRUE", "FALSE"}) || of(side, text[i]) != nullptr;
        if (!is_known && !is_declared(text[i])) return std::string(text[i]);
    }
    return {};
}

/// True if the unit's file, or the unit itself, opens a namespace, or takes a name out of it.
bool OwnNames::is_seen_without(std::string_view scope, std::string_view name, const UnitState& unit, Side side) const {
    if (!facts_.files || scope.size() < 2) return false;
    const std::string path = path_apart(scope.substr(0, scope.size() - 2)), opens = "using namespace " + path,
                      brings = "using " + path + " :: " + std::string(name);
    const Words words = unit.text.words();
    if (has_in_a_row(words, opens + " ;") || has_in_a_row(words, brings + " ;")) return true;
    const FilesOfSide& files = (*facts_.files)[side];
    for (size_t i = 0; i < files.size(); ++i) {
        if (files.path(i) != unit.file) continue;
        const ScannedFile& file = files.scanned(i);
        const std::vector<DeclaredWord> declared = declared_words(file);
        return std::any_of(declared.begin(), declared.end(), [&](const DeclaredWord& one) {
            const bool may_be = one.kind == DeclaredWord::Kind::Opened || one.kind == DeclaredWord::Kind::Brought;
            std::string says = may_be ? text_of(file, one) : std::string();
            while (says.ends_with(' ') || says.ends_with(';')) says.pop_back();
            return may_be && (says == opens || says == brings);
        });
    }
    return false;
}

bool OwnNames::is_asked_for_elsewhere(const std::string& macro, Side side) const {
    return facts_.files && !is_in_code_after(facts_, side, macro, "define") && !is_in_code(facts_, other(side), macro);
}

bool says_word(std::string_view text, std::string_view word) {
    const auto is_part = [](char c) { return is_word_token(std::string_view(&c, 1)) || (c >= '0' && c <= '9'); };
    for (size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
        const size_t end = at + word.size();
        if ((at == 0 || !is_part(text[at - 1])) && (end == text.size() || !is_part(text[end]))) return true;
    }
    return false;
}

bool is_in_code(const Case& facts, Side side, std::string_view word) { return is_in_code_after(facts, side, word, {}); }

bool is_in_code_of(const Case& facts, Side side, std::string_view path, std::string_view word) {
    const FilesOfSide& files = (*facts.files)[side];
    for (size_t i = 0; i < files.size(); ++i)
        if (files.path(i) == path)
            return says_word(files.text(i), word) && is_in_tokens(files.scanned(i).lexed, word, {});
    return false;
}

}  // namespace porttool

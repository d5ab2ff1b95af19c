// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/carried_names.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/text/is_one_of.h"

namespace porttool {

namespace {

bool is_enumeration(const UnitState& unit) {
    const Words words = unit.text.words();
    return unit.kind == UnitKind::Constant && words.size() > 2 && (words[0] == "enum" || words[1] == "enum");
}

}  // namespace

bool has_members(const UnitState& unit) { return unit.kind == UnitKind::Struct || is_enumeration(unit); }

Names new_members(const CheckedProject& checked, const LinesByPair& lines, const JudgedPair& pair, Side side) {
    Names out, old;
    const UnitState* unit = pair.unit[side];
    const LockedPair* line = lines.find(pair.id.source, pair.id.target);
    if (unit == nullptr || line == nullptr || !has_members(*unit)) return out;
    const Fingerprints& prints = side == Side::Source ? line->source_prints : line->target_prints;
    if (prints.written == unit->prints.written) return out;
    const NormalText before = text_behind(checked, prints.written);
    for (const std::string_view word : before.words()) old.emplace(word);
    const Words words = unit->text.words();
    for (size_t i = 1; i + 1 < words.size(); ++i) {
        const std::string_view next = words[i + 1], last = words[i - 1];
        const bool field = is_one_of(next, {";", ",", "[", "=", ":"});
        const bool enumerator = is_enumeration(*unit) && is_one_of(last, {"{", ","}) && next == "}";
        const bool method = next == "(" && (is_word_token(last) || last == "*" || last == "&");
        if ((field || method || enumerator) && is_word_token(words[i]) && !old.contains(words[i]))
            out.emplace(words[i]);
    }
    return out;
}

namespace {

/// True for a name behind a type, with what ends one of a declaration.
bool is_declaration(const std::vector<std::string>& words, size_t i) {
    if (i == 0 || i + 1 >= words.size() || !is_word_token(words[i])) return false;
    const std::string &last = words[i - 1], &next = words[i + 1];
    const bool typed = is_word_token(last) && (!word_is(last, kKeyword) || is_type_word(last));
    return typed && (next == "=" || next == ";" || next == "[");
}

}  // namespace

std::vector<size_t> declarations_of(const std::vector<std::string>& words, const std::string& name) {
    std::vector<size_t> out;
    for (size_t i = 0; i < words.size(); ++i)
        if (words[i] == name && is_declaration(words, i)) out.push_back(i);
    return out;
}

std::set<std::string> declared_twice(const std::vector<std::string>& words) {
    std::set<std::string> once, out;
    for (size_t i = 0; i < words.size(); ++i)
        if (is_declaration(words, i) && !once.insert(words[i]).second) out.insert(words[i]);
    return out;
}

bool lose_undeclared(const std::vector<std::string>& words, const Transplant& found, const Names& from_elsewhere,
                     Names& brought, Names& lone) {
    if (found.left.empty()) return false;
    std::set<size_t> carried;
    for (const WordsReplaced& one : found.replaced)
        for (const CarriedWord& word : one.words) carried.insert(word.from);
    for (const ClausesAdded& one : found.added)
        for (const ClauseAdded& clause : one.clauses)
            for (const CarriedWord& word : clause.words) carried.insert(word.from);
    bool any = false;
    for (auto name = brought.begin(); name != brought.end();) {
        const auto first = std::find(words.begin(), words.end(), *name);
        const std::vector<size_t> declared = declarations_of(words, *name);
        const bool is_declared =
            std::any_of(declared.begin(), declared.end(), [&](size_t i) { return carried.contains(i); });
        const bool is_lost = !from_elsewhere.contains(*name) && first != words.end() && !is_declared &&
                             !carried.contains(static_cast<size_t>(first - words.begin()));
        if (is_lost) lone.insert(*name);
        any |= is_lost;
        name = is_lost ? brought.erase(name) : std::next(name);
    }
    return any;
}

std::set<std::string> words_brought(const Transplant& found) {
    std::set<std::string> out;
    const auto add = [&](const std::vector<CarriedWord>& words) {
        for (size_t i = 0; i < words.size(); ++i)
            if (i == 0 || (words[i - 1].text != "." && words[i - 1].text != "->")) out.insert(words[i].text);
    };
    for (const WordsReplaced& one : found.replaced) add(one.words);
    for (const ClausesAdded& one : found.added)
        for (const ClauseAdded& clause : one.clauses) add(clause.words);
    return out;
}

}  // namespace porttool

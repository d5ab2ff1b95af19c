// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/assess.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "porttool/compare/computed_values.h"
#include "porttool/compare/edits.h"
#include "porttool/compare/guarded_words.h"
#include "porttool/compare/numbered_text.h"
#include "porttool/compare/plain_references.h"
#include "porttool/compare/values.h"
#include "porttool/language/language.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

BySide<Language> languages_of_units(const UnitState& source, const UnitState& target) {
    return {language_of_path(source.file), language_of_path(target.file)};
}

std::vector<std::string> statement_keys(const Words& words, Side side, const Meaning& meaning) {
    const Translator translator = [&](const Words& statement, bool in_body) {
        return meaning.translate(statement, side, in_body);
    };
    std::vector<std::string> out;
    for (Statement& statement : split_statements(words, translator)) out.push_back(std::move(statement.key));
    return out;
}

bool are_twins(const UnitState& source, const UnitState& target, const Dialect& dialect,
               const BySide<Language>& languages) {
    const Words left = source.text.words(), right = target.text.words(), none;
    const NumberedText a(left), b(right);
    if (!guarded_difference({none, left, none, right}).empty()) return false;
    const BySide<Words> plain = with_plain_references({a.words(), b.words()});
    const Meaning meaning({none, plain.source, none, plain.target}, dialect, languages);
    return statement_keys(plain.source, Side::Source, meaning) == statement_keys(plain.target, Side::Target, meaning);
}

/// How much of the words both have, each as often as it stands there: twice the common ones by all.
double shared_words_of(const UnitState& source, const UnitState& target, const Dialect& dialect) {
    std::map<std::string, std::pair<size_t, size_t>> counts;
    for (const std::string_view word : source.text.words()) ++counts[common_word(word, dialect)].first;
    for (const std::string_view word : target.text.words()) ++counts[common_word(word, dialect)].second;
    size_t common = 0, all = 0;
    for (const auto& [word, count] : counts) {
        const char first = word.empty() ? ' ' : word[0];
        if (!is_word_token(word) && !is_number_token(word) && first != '%') continue;  // signs are all alike
        common += 2 * std::min(count.first, count.second);
        all += count.first + count.second;
    }
    return all == 0 ? 1 : static_cast<double>(common) / static_cast<double>(all);
}

constexpr double kAlike = 0.4;  ///< of the words, from which on two bodies are about the same thing

}  // namespace

Assessment assess(const UnitState& source, const UnitState& target, const Dialect& dialect, CompareBudget& budget) {
    CompareSize size;
    for (const UnitState* unit : {&source, &target}) size.add(unit->text.size());
    if (!budget.refusal({source.id, target.id}, size).empty()) return Assessment::Differs;
    const BySide<Language> languages = languages_of_units(source, target);
    if (are_twins(source, target, dialect, languages)) return Assessment::Twin;
    const Words left = source.text.words(), right = target.text.words(), none;
    const bool has_values = source.kind == UnitKind::Constant || source.kind == UnitKind::Struct;
    if (has_values && source.kind == target.kind) {
        const ComparedValues values = compare_values(source.kind, left, right, dialect);
        return values.same ? Assessment::Equivalent : Assessment::Differs;
    }
    const NumberedText a(left), b(right);
    const bool alike = are_handed_alike(with_plain_references({a.words(), b.words()}));
    if (alike && compare_edits({none, left, none, right}, dialect, languages).equivalent) return Assessment::Equivalent;
    if (guarded_difference({none, left, none, right}).empty() && compute_alike({left, right}, dialect, languages))
        return Assessment::Equivalent;
    return shared_words_of(source, target, dialect) < kAlike ? Assessment::Unlike : Assessment::Differs;
}

}  // namespace porttool

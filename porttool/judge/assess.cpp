// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/assess.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "porttool/compare/edits.h"
#include "porttool/compare/guarded_words.h"
#include "porttool/compare/values.h"
#include "porttool/language/language.h"
#include "porttool/normal/locals.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

BySide<Language> languages_of_units(const UnitState& source, const UnitState& target) {
    return {language_of_path(source.file), language_of_path(target.file)};
}

/// A text with its locals numbered; the words live in `numbers`.
class Numbered {
public:
    explicit Numbered(const Words& text) : words_(text) {
        const std::vector<size_t> locals = local_numbers(text);
        if (locals.empty()) return;
        numbers_.reserve(text.size());  // no word moves
        for (size_t i = 0; i < text.size(); ++i)
            if (locals[i] != 0) words_[i] = numbers_.emplace_back("%" + std::to_string(locals[i]));
    }
    const Words& words() const { return words_; }

private:
    Words words_;
    std::vector<std::string> numbers_;
};

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
    const Numbered a(left), b(right);
    if (!guarded_difference({none, left, none, right}).empty()) return false;
    const Meaning meaning({none, a.words(), none, b.words()}, dialect, languages);
    return statement_keys(a.words(), Side::Source, meaning) == statement_keys(b.words(), Side::Target, meaning);
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
    if (compare_edits({none, left, none, right}, dialect, languages).equivalent) return Assessment::Equivalent;
    return shared_words_of(source, target, dialect) < kAlike ? Assessment::Unlike : Assessment::Differs;
}

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/settled_edits.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "porttool/compare/guarded_words.h"
#include "porttool/compare/side_by_side.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/normal/diff.h"

namespace porttool {
namespace {

constexpr size_t kMostWordsCompared = 100'000;

Words keys_of(const std::vector<Statement>& statements) {
    Words out;
    for (const Statement& statement : statements) out.push_back(statement.key);
    return out;
}

constexpr size_t kNoLike = static_cast<size_t>(-1);

/// For each statement of both texts its like in the other, in the same order, or kNoLike.
BySide<std::vector<size_t>> alike(const std::vector<Statement>& source, const std::vector<Statement>& target) {
    BySide<std::vector<size_t>> out{std::vector<size_t>(source.size(), kNoLike),
                                    std::vector<size_t>(target.size(), kNoLike)};
    for (const DiffStep& step : diff(keys_of(source), keys_of(target))) {
        if (step.kind != DiffStep::Keep) continue;
        out.source[step.before] = step.now;
        out.target[step.now] = step.before;
    }
    return out;
}

/// True if the two say something about the same things.
bool are_akin(const Statement& a, const Statement& b) {
    std::multiset<std::string> numbers, other_numbers;
    std::set<std::string> names, other_names;
    const auto read = [](const Statement& from, auto& of_numbers, auto& of_names) {
        for (const std::string& word : from.common) {
            if (is_number_token(word)) of_numbers.insert(word);
            if (is_word_token(word)) of_names.insert(word);
        }
    };
    read(a, numbers, names);
    read(b, other_numbers, other_names);
    const auto shared = static_cast<size_t>(
        std::count_if(names.begin(), names.end(), [&](const std::string& name) { return other_names.contains(name); }));
    if (2 * shared >= std::max<size_t>(1, std::max(names.size(), other_names.size()))) return true;
    return !numbers.empty() && numbers == other_numbers && names.size() == other_names.size();
}

class SettledReader {
public:
    SettledReader(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages)
        : meaning_(texts, dialect, languages),
          edits_{statement_edit(texts.source_before, texts.source_now, translator(Side::Source)),
                 statement_edit(texts.target_before, texts.target_now, translator(Side::Target))},
          then_(alike(edits_.source.before, edits_.target.before)),
          today_(alike(edits_.source.now, edits_.target.now)) {}

    bool run() const {
        return is_settled(Side::Source) && is_settled(Side::Target) &&
               (own_words_went_together() ||
                (own_words_stood_alone(Side::Source) && own_words_stood_alone(Side::Target)));
    }

private:
    Translator translator(Side side) const {
        return translated_once([this, side](const Words& statement, bool in_body) {
            return meaning_.translate(statement, side, in_body);
        });
    }

    /// All that came has its like, and what stayed has it still if it had it.
    bool is_settled(Side side) const {
        const StatementEdit& edit = edits_[side];
        if (edit.gained.empty() && edit.lost.empty()) return false;
        if (!std::all_of(edit.gained.begin(), edit.gained.end(), [&](size_t i) { return today_[side][i] != kNoLike; }))
            return false;
        const std::vector<size_t> kept = edit.kept();
        for (size_t i = 0; i < kept.size(); ++i)
            if (kept[i] != StatementEdit::kGone && then_[side][i] != kNoLike && today_[side][kept[i]] == kNoLike)
                return false;
        return true;
    }

    /// What went and had no like.
    std::vector<const Statement*> own_words(Side side) const {
        std::vector<const Statement*> out;
        for (const size_t i : edits_[side].lost)
            if (then_[side][i] == kNoLike && !edits_[side].before[i].is_brace()) out.push_back(&edits_[side].before[i]);
        return out;
    }

    bool own_words_went_together() const {
        const auto source = own_words(Side::Source), target = own_words(Side::Target);
        return std::equal(source.begin(), source.end(), target.begin(), target.end(),
                          [](const Statement* a, const Statement* b) { return are_akin(*a, *b); });
    }

    /// Where what went in own words stood the other side had nothing, or nothing that is still there: it was no port of
    /// anything.
    bool own_words_stood_alone(Side side) const {
        const std::vector<Statement>& there = edits_[other(side)].before;
        const std::vector<size_t> kept = edits_[other(side)].kept();
        for (const size_t i : edits_[side].lost) {
            if (then_[side][i] != kNoLike || edits_[side].before[i].is_brace()) continue;
            size_t first = 0, end = there.size();
            for (size_t k = i; k-- > 0;)
                if (then_[side][k] != kNoLike) {
                    first = then_[side][k] + 1;
                    break;
                }
            for (size_t k = i + 1; k < then_[side].size(); ++k)
                if (then_[side][k] != kNoLike) {
                    end = then_[side][k];
                    break;
                }
            for (size_t k = first; k < end; ++k)
                if (!there[k].is_brace() && kept[k] != StatementEdit::kGone) return false;
        }
        return true;
    }

    Meaning meaning_;
    BySide<StatementEdit> edits_;
    BySide<std::vector<size_t>> then_, today_;
};

}  // namespace

bool edits_leave_no_difference(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages) {
    const size_t words =
        texts.source_before.size() + texts.source_now.size() + texts.target_before.size() + texts.target_now.size();
    if (words > kMostWordsCompared || !guarded_difference(texts).empty()) return false;
    return SettledReader(texts, dialect, languages).run();
}

}  // namespace porttool

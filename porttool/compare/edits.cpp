// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/edits.h"

#include <algorithm>

#include "porttool/compare/guarded_words.h"
#include "porttool/compare/hints.h"
#include "porttool/compare/lone_statements.h"
#include "porttool/compare/positions.h"
#include "porttool/compare/renaming.h"
#include "porttool/compare/same_words.h"
#include "porttool/compare/side_edit.h"
#include "porttool/normal/diff.h"

namespace porttool {
namespace {

/// What an edit that only moved closing braces did: statements that stand in another block now.
void show_moved(const StatementEdit& edit, Edit& out) {
    const std::vector<size_t> now_of = edit.kept();
    for (size_t i = 0; i < edit.before.size(); ++i) {
        if (edit.before[i].is_brace() || now_of[i] == StatementEdit::kGone) continue;
        const std::string old_block = block_of(edit.before, i), new_block = block_of(edit.now, now_of[i]);
        if (old_block == new_block) continue;
        out.lost.push_back(edit.before[i].shown + " (in " + old_block + ")");
        out.gained.push_back(edit.before[i].shown + " (in " + new_block + ")");
    }
}

/// `has_updates` becomes true if updates in one manner would make other words.
EditComparison compare_in_manner(const PairTexts& texts, const Meaning& meaning, bool& has_updates) {
    const auto translator = [&](Side side) {
        return translated_once([&meaning, &has_updates, side](const Words& statement, bool in_body) {
            return meaning.translate(statement, side, in_body, &has_updates);
        });
    };
    const StatementEdit source = statement_edit(texts.source_before, texts.source_now, translator(Side::Source));
    const StatementEdit target = statement_edit(texts.target_before, texts.target_now, translator(Side::Target));
    EditComparison out;
    out.equivalent = same_replacements(source, target);
    if (out.equivalent) return out;
    const bool alike = same_words(source, target);
    if (!alike) {
        MissingStatements missing = missing_statements(source, target);
        out.differences = std::move(missing.sentences);
        out.left = missing.count;
    }
    if (out.differences.empty()) {
        PositionDifferences positions = other_positions(source, target);
        out.differences = std::move(positions.sentences);
        out.displaced = positions.is_sure;
    }
    out.equivalent = alike && out.differences.empty();
    if (out.differences.empty() && !alike) out.differences.emplace_back("the two sides were rearranged differently");
    return out;
}

/// Compares the edits by the names that the texts have.
EditComparison compare_as_named(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages) {
    bool has_updates = false;
    EditComparison out =
        compare_in_manner(texts, Meaning(texts, dialect, languages, Meaning::Updates::AsWritten), has_updates);
    if (out.equivalent || out.displaced || !has_updates || texts.source_before.empty()) return out;
    const Meaning in_one_manner(texts, dialect, languages, Meaning::Updates::InOneManner);
    if (compare_in_manner(texts, in_one_manner, has_updates).equivalent) return {.equivalent = true};
    return out;
}

}  // namespace

Change classify(const Fingerprints& before, const Fingerprints& now) {
    if (before.written == now.written) return Change::None;
    if (before.renamed == now.renamed) return Change::Cosmetic;
    return before.blanked == now.blanked ? Change::Constant : Change::Semantic;
}

Edit shown_edit(const StatementEdit& edit) {
    Edit out;
    for (const size_t i : edit.gained)
        if (!edit.now[i].is_brace()) out.gained.push_back(edit.now[i].shown);
    for (const size_t i : edit.lost)
        if (!edit.before[i].is_brace()) out.lost.push_back(edit.before[i].shown);
    if (out.gained.empty() && out.lost.empty()) show_moved(edit, out);
    return out;
}

Edit edit_of(const Words& before, const Words& now) {
    const auto as_written = [](const Words& statement, bool) {
        return std::vector<std::string>(statement.begin(), statement.end());
    };
    return shown_edit(statement_edit(before, now, as_written));
}

EditComparison compare_edits(const PairTexts& written, const Dialect& dialect, const BySide<Language>& languages) {
    const Words source_before = without_hints(written.source_before), now_of_source = without_hints(written.source_now),
                target_before = without_hints(written.target_before), now_of_target = without_hints(written.target_now);
    const PairTexts texts{source_before, now_of_source, target_before, now_of_target};
    EditComparison out = compare_as_named(texts, dialect, languages);
    if (const std::string guarded = guarded_difference(texts); !guarded.empty()) {
        out.equivalent = false;
        out.differences.insert(out.differences.begin(), guarded);
        return out;
    }
    if (out.equivalent) return out;
    const auto source = with_old_names(texts.source_before, texts.source_now, dialect);
    const auto target =
        with_new_names_of_source(texts.source_before, source, texts.target_before,
                                 with_old_names(texts.target_before, texts.target_now, dialect), dialect);
    if (source == texts.source_now && target == texts.target_now) return out;
    EditComparison renamed =
        compare_as_named({texts.source_before, source, texts.target_before, target}, dialect, languages);
    // Sentences with names that no longer stand there help only where they make the list shorter.
    const bool shorter = renamed.differences.size() < out.differences.size();
    return renamed.equivalent || shorter ? renamed : out;
}

bool now_says_what_other_says(const LoneTexts& texts, Side side, const Dialect& dialect,
                              const BySide<Language>& languages) {
    constexpr size_t kLeastWords = 4, kMost = 100'000;  // of a statement that is none by chance; of all words
    const Words before = without_hints(texts.before), now = without_hints(texts.now),
                there = without_hints(texts.other);
    if (before.size() + now.size() + there.size() > kMost) return false;
    const LoneStatements found({before, now, there}, side, dialect, languages);
    const auto& edit = found.edit;
    const bool tells = std::any_of(edit.gained.begin(), edit.gained.end(),
                                   [&](size_t i) { return edit.now[i].common.size() >= kLeastWords; });
    if (!tells || (edit.gained.size() == 1 && edit.lost.size() == 1)) return false;
    if (found.in_common(edit.now) < found.in_common(edit.before) + edit.gained.size()) return false;
    return !brings_part_of(SideEdit({}, there, dialect), SideEdit(before, now, dialect));
}

}  // namespace porttool

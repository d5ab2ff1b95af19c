// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/compare/edits.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/normal/diff.h"

namespace porttool {

/// The edit of one side alone beside the other side's statements, in common words. The texts must outlive it.
struct LoneStatements {
    LoneStatements(const LoneTexts& texts, Side side, const Dialect& dialect, const BySide<Language>& languages) {
        const bool source = side == Side::Source;
        const PairTexts pair = source ? PairTexts{texts.before, texts.now, texts.other, texts.other}
                                      : PairTexts{texts.other, texts.other, texts.before, texts.now};
        const Meaning meaning(pair, dialect, languages);
        const auto translator = [&](Side each) {
            return [&meaning, each](const Words& statement, bool in_body) {
                return meaning.translate(statement, each, in_body);
            };
        };
        edit = statement_edit(texts.before, texts.now, translator(side));
        others = split_statements(texts.other, translator(other(side)));
    }

    /// How many statements the other side has as well, in their order.
    size_t in_common(const std::vector<Statement>& here) const {
        Words left, right;
        for (const Statement& statement : here) left.push_back(statement.key);
        for (const Statement& statement : others) right.push_back(statement.key);
        size_t kept = 0;
        for (const DiffStep& step : diff(left, right)) kept += step.kind == DiffStep::Keep ? 1 : 0;
        return kept;
    }

    StatementEdit edit;
    std::vector<Statement> others;
};

}  // namespace porttool

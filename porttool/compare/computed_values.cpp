// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/computed_values.h"

#include "porttool/compare/hints.h"
#include "porttool/compare/meaning.h"
#include "porttool/compare/numbered_text.h"
#include "porttool/compare/plain_references.h"
#include "porttool/normal/prelude.h"
#include "porttool/normal/statements.h"
#include "porttool/value_graph/same_values.h"

namespace porttool {
namespace {

constexpr size_t kMostComputed = 5'000;  ///< of each text

bool is_shading(Language language) { return traits_of(language).literals == Literals::Shading; }

}  // namespace

bool compute_alike(const BySide<Words>& texts, const Dialect& dialect, const BySide<Language>& languages) {
    if (texts.source.size() > kMostComputed || texts.target.size() > kMostComputed) return false;
    const NumberedText source(without_hints(without_prelude(texts.source))),
        target(without_hints(without_prelude(texts.target)));
    const BySide<Words> plain = with_plain_references({source.words(), target.words()});
    const Words none;
    const Meaning meaning({none, plain.source, none, plain.target}, dialect, languages);
    const auto statements = [&](const Words& words, Side side) {
        return split_statements(words, [&meaning, side](const Words& statement, bool in_body) {
            return meaning.translate(statement, side, in_body);
        });
    };
    const std::vector<Statement> here = statements(plain.source, Side::Source),
                                 there = statements(plain.target, Side::Target);
    const bool shading = is_shading(languages.source) || is_shading(languages.target);
    const ReadingManner manner{dialect, shading, {}};
    // Whose classes stand for whose vectors is asked from the side that has vectors.
    return give_the_same({here, manner}, {there, manner}) || give_the_same({there, manner}, {here, manner});
}

}  // namespace porttool

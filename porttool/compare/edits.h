// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/compare/meaning.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/language/dialect.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/side.h"

namespace porttool {

enum class Change : uint8_t { None, Cosmetic, Constant, Semantic };

/// How a unit changed, by its prints alone: a consistent renaming of locals and parameters is cosmetic.
Change classify(const Fingerprints& before, const Fingerprints& now);

/// What one side's edit did, statement by statement, as a reader sees it.
struct Edit {
    std::vector<std::string> gained;
    std::vector<std::string> lost;
};

/// Two edits of one pair held against each other after translation into one vocabulary.
struct EditComparison {
    bool equivalent = false;
    std::vector<std::string> differences;  ///< sentences: what is missing on which side
    BySide<size_t> left = {0, 0};          ///< statements of each side's edit that the other's lacks
    bool displaced = false;                ///< what both did is the same, and surely at another place
};

/// Compares the edit before -> now of the source with that of the target. All four are tokens in normal form. Locals
/// may have been renamed on either side, and those that are new may have another name on each. Edits are equivalent if
/// they lost and gained the same statements, or the same words in statements that stand for each other, in the same
/// positions: blocks and neighbours count.
///
///                 source                            port
///     before      a = b ;                           a = b ;
///     now         a = b * 2f ; c = a ;              a = b * 2.0 ; d = a ;      equivalent in GLSL, c new and called d
///     or now      a = b * 2f ; c = a ;              c = a ; a = b * 2.0 ;      not: the position
///     or now      a = b * 2f ; c = a ;              a = b * 2.0 ;              not: the port did not gain `c = a`
EditComparison compare_edits(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages);

/// The same statements for a reader; of an edit that only moved closing braces, what stands in another block now.
Edit shown_edit(const StatementEdit& edit);

/// What changed between two texts, as written.
Edit edit_of(const Words& before, const Words& now);

/// The texts of a side that changed alone, and that of the other.
struct LoneTexts {
    Words before, now, other;
};

/// True if all that the edit brought in stands in the other side's text at its place, where nothing of what it took
/// away stood: the side has caught up. One statement that took the place of another is not enough: it may be so by
/// chance.
///
///     before      a = f(x);                                source
///     now         b = g(x, 2);  if (b > 1) {  a = f(b);  }
///     other       b = g(x, 2);  if (b > 1) {  a = f(b);  }  port
bool now_says_what_other_says(const LoneTexts& texts, Side side, const Dialect& dialect,
                              const BySide<Language>& languages);

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "porttool/compare/edits.h"
#include "porttool/compare/laid_edit.h"
#include "porttool/language/dialect.h"

namespace porttool {

/// True if edits of both sides are for the most part one, each in the words of its side: the two texts are about as
/// much alike as before, no number, operator or name came or went on one side alone, and none that came stands where
/// the other side has another, but for words of one side's own, and statements of the same words have the same
/// brackets, and end as much. Less sure than compare_edits(), which holds statement against statement.
///
///                 source                              port
///     before      y[i] = x[i];                        store(y + i, load(x + i));
///     now         y[i] = max(x[i], lim) * 0.5f;       store(y + i, std::max(load(x + i), lim) * 0.5f);
///     or now      y[i] = max(x[i], lim) * 0.5f;       store(y + i, std::max(load(x + i), lim));          not: 0.5
bool edits_in_own_words(const PairTexts& texts, const Dialect& dialect);

/// True if edits of both sides came with other members of what each side calls the same: `vol.shortest` for
/// `vol.least`, where both texts say `vol.step` as well. One side may have another name for it, or the port a wrong
/// one.
bool bring_other_members(const PairTexts& texts, const Dialect& dialect);

/// True if one side's edit took a name that both said before, and the other says it as often as it did: what it took
/// with that stands there still.
///
///                 source                                      port
///     before      w *= hit.albedo;                            weight *= at.albedo;
///     now         w *= hit.albedo; if (w < q) stop(w / q);    if (weight < q) stop(weight / q);
bool one_takes_a_name(const PairTexts& texts, const Dialect& dialect);

/// True if less than one word in ten of two texts has no like in the other: such texts are held to every word.
bool are_twins(const Words& a, const Words& b, const Dialect& dialect);

/// Whether an edit of one side alone says what the other side has.
enum class Nearing : uint8_t {
    No,
    InAnotherOrder,    ///< its words, some of them where the other side has others, or in other brackets or types: a
                       ///< wrong port, or another manner
    InPart,            ///< see brings_part_of()
    WithOtherMembers,  ///< but for a member or function, see bring_other_members()
    Yes,
};

/// Yes if an edit of one side alone brings it nearer to the other side's text, which has what the edit brings in and
/// nothing of what it takes away: a third of what was edited has its like there now and had none before, and no number
/// or operator stands alone now that had its like before, or is new. Less sure than now_says_what_other_says(). Of two
/// or three words all that was edited has to have its like; an edit of one is never that. How often words stand there
/// tells nothing of `clamp(x, hi, lo)` for `clamp(x, lo, hi)`: so each number, operator and name of both sides that
/// came has to stand where the other side has its like, too.
///
///     before      y = x[i];                                                        port
///     now         if (lim > 0) { const float c = damp(x, lim, 0.5f); y = c; }
///     other       if (lim > 0) { const float d = damp(x, lim, 0.5f); y = d; }      source
Nearing draws_nearer(LaidEdit& laid);

}  // namespace porttool

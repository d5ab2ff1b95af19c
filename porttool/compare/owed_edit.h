// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "porttool/compare/laid_edit.h"

namespace porttool {

/// What else tells whether an edit is owed, asked only where the texts leave it open.
struct OwedBy {
    std::function<bool()> are_namesakes;    ///< both units bear one name
    std::function<bool()> is_of_own_words;  ///< the ports of this project say little as their sources do
};

/// False of an edit of one side alone that has little to do with the other side's text: it is in doubt that the other
/// side owes it. A slip, words that are never silent, the same words in another order and numbers in the place of
/// numbers are owed by whatever bears the same name, and by others unless next to nothing around the edit has its like.
/// Where ports have words of their own a name tells little, and more must be alike. Edits of short texts, whose words
/// have their like by chance, are owed.
bool is_likely_owed(LaidEdit& laid, const OwedBy& by);

/// False if less than half of the names, numbers and operators of a text before its edit and of the other side's have
/// their like in the other: whether two edits of such texts are one is hard to tell.
bool are_mostly_alike(LaidEdit& laid);

}  // namespace porttool

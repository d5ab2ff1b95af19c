// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/laid_edit.h"

namespace porttool {

/// False of an edit of one side alone that has little to do with the other side's text: it is in doubt that the other
/// side owes it. A slip, words that are never silent, the same words in another order and numbers in the place of
/// numbers are owed by whatever bears the same name, and so are edits of short texts, whose words have their like by
/// chance; by others unless next to nothing around the edit has its like.
bool is_likely_owed(LaidEdit& laid, bool are_namesakes);

/// False if less than half of the names, numbers and operators of a text before its edit and of the other side's have
/// their like in the other: whether two edits of such texts are one is hard to tell.
bool are_mostly_alike(LaidEdit& laid);

}  // namespace porttool

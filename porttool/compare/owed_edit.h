// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/laid_edit.h"

namespace porttool {

/// False of an edit of one side alone, of more than a dozen words, of which little has to do with the other side's
/// text: it is in doubt that the other side owes it. True of words that are never silent, of the same words in another
/// order, of numbers in the place of numbers, and of short texts, whose words have their like by chance.
bool is_likely_owed(LaidEdit& laid);

}  // namespace porttool

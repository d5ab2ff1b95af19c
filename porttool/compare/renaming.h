// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

// Both functions rename locals and parameters only, only all uses of one at once, and only to a word that the text does
// not use yet in any spelling. So what they return always does what the text did: a pairing of names that is wrong
// costs a false alarm and hides nothing. All texts are functions in normal form; others come back as they are.

/// `now` with the names that `before` had, where locals were renamed since.
///
///     before    float r = x ; return r ;
///     now       float s = x + y ; return s ;      becomes  float r = x + y ; return r ;
///     now       float s = r ; return s ;          stays: r is in use
Words with_old_names(const Words& before, const Words& now, const Dialect& dialect);

/// `target_now` with the locals that are new in it named as those that are new in the source, in their order.
Words with_new_names_of_source(const Words& source_before, const Words& source_now, const Words& target_before,
                               const Words& target_now, const Dialect& dialect);

}  // namespace porttool

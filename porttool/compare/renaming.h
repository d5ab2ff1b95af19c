// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/language/dialect.h"

namespace porttool {

// Both functions rename locals and parameters only, only all uses of one at once, and only to a word that the text does
// not use yet in any spelling. So what they return always does what the text did: a pairing of names that is wrong
// costs a false alarm and hides nothing. All texts are functions in normal form; others come back as they are.

/// `now` with the names that `before` had, where locals were renamed since.
std::vector<std::string> with_old_names(const std::vector<std::string>& before, const std::vector<std::string>& now,
                                        const Dialect& dialect);

/// `target_now` with the locals that are new in it named as those that are new in the source, in their order.
std::vector<std::string> with_new_names_of_source(const std::vector<std::string>& source_before,
                                                  const std::vector<std::string>& source_now,
                                                  const std::vector<std::string>& target_before,
                                                  const std::vector<std::string>& target_now, const Dialect& dialect);

}  // namespace porttool

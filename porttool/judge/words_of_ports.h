// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "porttool/judge/judge.h"
#include "porttool/judge/own_names.h"
#include "porttool/language/dialect.h"

namespace porttool {

/// How the ports of a project say what their sources say: in the same words, as twins do, or in words of their own.
class WordsOfPorts {
public:
    /// All must outlive it.
    WordsOfPorts(const Case& facts, const Dialect& dialect, OwnNames& own_names)
        : facts_(facts), dialect_(dialect), own_names_(own_names) {}

    /// True if most pairs of one name have texts that say little alike: a name that both sides have then tells little
    /// about an edit. Of two dozen pairs at most, from all over the map; never of a few.
    bool are_their_own();

private:
    std::optional<bool> are_their_own_;  ///< worked out when first asked

    const Case& facts_;
    const Dialect& dialect_;
    OwnNames& own_names_;
};

}  // namespace porttool

// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "porttool/difftest/definitions.h"

namespace porttool {

/// The parts of a list between commas that stand in no brackets, angle brackets among them.
std::vector<TokenRange> list_parts(const LexedText& lexed, TokenRange range);

/// How many arguments a call has. A `<` between commas may compare or open a list: then there are two answers.
struct ArgumentCount {
    size_t least = 0, most = 0;
};

/// The arguments of the call that begins with the name at `i`; none where it is no call that closes before `end`.
std::optional<ArgumentCount> arguments_of_call(const LexedText& lexed, uint32_t i, uint32_t end);

/// What of `found` a call with so many arguments may mean. All of it where none of them takes so many: what looks like
/// one argument can be a macro that writes several.
std::vector<const Definition*> callable(const std::vector<const Definition*>& found,
                                        std::optional<ArgumentCount> arguments);

}  // namespace porttool

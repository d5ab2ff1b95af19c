// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/normal/statements.h"

namespace porttool {

/// An edit as statements. Statements are equal if they are in translation; closing braces are statements, too.
///
///     before           now                lost     gained
///     0  float @ ()    0  float @ ()      2        1, 3
///     1  a = b         1  if (b > 0)
///     2  c = a         2  a = b
///     3  return c      3  }
///     4  }             4  return c
///                      5  }
struct StatementEdit {
    static constexpr size_t kGone = static_cast<size_t>(-1);

    std::vector<Statement> before, now;
    std::vector<size_t> lost, gained;  ///< indices into before and now

    /// For each statement of `before` its index in `now`, or kGone.
    std::vector<size_t> kept() const;
};

/// The same translator, which translates a statement but once: texts that are held against each other have most of
/// theirs in common.
Translator translated_once(Translator translator);

StatementEdit statement_edit(const Words& before, const Words& now, const Translator& translator);

/// A statement as it is quoted beside others: many can stand in or after a single long one.
std::string quoted(const Statement& statement);

/// The block that a statement stands in, by its head, for a reader.
std::string block_of(const std::vector<Statement>& statements, size_t i);

}  // namespace porttool

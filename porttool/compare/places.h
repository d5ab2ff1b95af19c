// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/normal/statements.h"

namespace porttool {

/// An edit as statements, with where they stand.
struct StatementEdit {
    static constexpr size_t kGone = static_cast<size_t>(-1);

    std::vector<Statement> before, now;
    std::vector<size_t> lost, gained;  ///< indices into before and now

    /// For each statement of `before` its index in `now`, or kGone.
    std::vector<size_t> kept() const;
};

StatementEdit statement_edit(const Words& before, const Words& now, const Translator& translator);

/// The block that a statement stands in, by its head, for a reader.
std::string block_of(const std::vector<Statement>& statements, size_t i);

/// Sentences on what the two edits lost or gained in different places; none if the places are the same. The statements
/// that the two sides share tell one place from another, closing braces among them: the k-th statement lost or gained
/// stands behind as many of them on each side.
std::vector<std::string> other_places(const StatementEdit& source, const StatementEdit& target);

}  // namespace porttool

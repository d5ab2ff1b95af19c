// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "porttool/compare/alignment.h"

namespace porttool {

/// A statement that declares names and gives none of them a value: `float * a , * b ;`.
struct BareDeclaration {
    std::vector<std::string> type;  ///< without what belongs to one name, as `*`
    std::set<std::string> names;
    bool is_plain = false;  ///< of built-in types and pointers alone: nothing runs where it stands
};

std::optional<BareDeclaration> bare_declaration(const AlignedText& text, const Clause& clause);

/// True if statements of a text declare all names of a declaration with its type, and with no value.
bool declares_all(const AlignedText& text, const BareDeclaration& declaration);

}  // namespace porttool

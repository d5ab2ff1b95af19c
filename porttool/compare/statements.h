// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/compare/dialect.h"

namespace porttool {

/// A statement, a control head or a brace, as written and in the common vocabulary.
struct Statement {
    std::string shown;                ///< readable
    std::vector<std::string> common;  ///< translated tokens
    std::string key;                  ///< the same as one text
};

/// One token in the common vocabulary; "" for what has no counterpart elsewhere.
std::string common_word(const std::string& token, const Dialect& dialect);

/// Cuts tokens in normal form into statements. Empty ones and lone braces are left out, but for the nesting depth that
/// becomes part of no key.
std::vector<Statement> split_statements(const std::vector<std::string>& tokens, const Dialect& dialect);

/// A step of the shortest way from one list to another.
struct DiffStep {
    enum Kind { Keep, Remove, Add } kind;
    size_t before;
    size_t now;
};

/// The longest common subsequence of two lists of texts as steps. Very long lists are compared only between their equal
/// ends, as one replacement.
std::vector<DiffStep> diff(const std::vector<std::string>& before, const std::vector<std::string>& now);

}  // namespace porttool

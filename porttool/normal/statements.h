// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// A statement, a control head or a brace, as written and in the common vocabulary.
struct Statement {
    std::string shown;                ///< readable
    std::vector<std::string> common;  ///< translated tokens
    std::string key;                  ///< the same as one text
    /// The statement at the head of the block that it stands in, or for a closing brace of the block that it closes.
    size_t head = kNoHead;

    static constexpr size_t kNoHead = static_cast<size_t>(-1);
    bool is_brace() const { return shown == "}"; }
};

/// A name without what differs between the manners of languages: case and underscores.
std::string folded(std::string_view word);

/// One token in the common vocabulary; "" for what has no counterpart elsewhere.
std::string common_word(std::string_view token, const Dialect& dialect);

/// Translates a statement's tokens; `in_body` is false for what stands before the first brace.
using Translator = std::function<std::vector<std::string>(const Words& tokens, bool in_body)>;

/// Cuts tokens in normal form into statements. Empty ones and opening braces are left out.
std::vector<Statement> split_statements(const Words& tokens, const Translator& translator);

/// The same in the common vocabulary.
std::vector<Statement> split_statements(const Words& tokens, const Dialect& dialect);

}  // namespace porttool
